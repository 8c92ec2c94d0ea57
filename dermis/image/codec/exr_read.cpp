// OpenEXR reading: any compression, scanlines or tiles (the largest level), the first part of several. The
// picture is the display window: texels that the data window does not hold are 0, those outside are left out.

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/core.h>

#include <Iex.h>

#include <algorithm>
#include <array>
#include <map>

#include "dermis/base/text.h"
#include "dermis/image/codec/exr.h"

namespace dermis::inline image::codec {
namespace {

struct Channel {
    std::string name;        // in the file
    std::string short_name;  // after the last dot
    Imf::PixelType type;
    int order = 0;  // see order_of
};
using Layers = std::map<std::string, std::vector<Channel>>;

// The order within a layer: luminance or red, green, blue; then other names, alphabetically (X Y Z, U V);
// then alpha.
enum ChannelOrder { kLuminance, kRed, kGreen, kBlue, kOther, kAlpha };
int order_of(const std::string& short_name) {
    struct Name {
        std::string_view letter, word;
    };
    constexpr std::array<Name, 6> kNames = {
        {{"y", ""}, {"r", "red"}, {"g", "green"}, {"b", "blue"}, {"", ""}, {"a", "alpha"}}};
    const std::string lower = to_lower(short_name);
    for (size_t i = 0; i < kNames.size(); ++i)
        if (!lower.empty() && (lower == kNames[i].letter || lower == kNames[i].word)) return int(i);
    return kOther;
}

bool has(const std::vector<Channel>& channels, std::string_view short_name) {
    return std::ranges::find(channels, short_name, &Channel::short_name) != channels.end();
}

void sort_channels(std::vector<Channel>& channels) {
    for (Channel& c : channels) {
        c.order = order_of(c.short_name);
        // With an X, a Y is a coordinate, not luminance.
        if (c.order == kLuminance && has(channels, "X")) c.order = kOther;
    }
    std::ranges::stable_sort(channels, {}, &Channel::order);
}

Result<Layers> collect_layers(const Imf::ChannelList& list) {
    Layers layers;
    for (auto it = list.begin(); it != list.end(); ++it) {
        const std::string name = it.name();
        if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
            return Error{"EXR with the subsampled channel '" + name + "'; dermis reads full resolution"};
        const size_t dot = name.rfind('.');
        const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
        layers[layer].push_back(
            {name, dot == std::string::npos ? name : name.substr(dot + 1), it.channel().type});
    }
    for (auto& [name, channels] : layers) sort_channels(channels);
    return layers;
}

// Without a layer name: R G B A or Y A where there are any, whatever else the file holds beside them (a depth
// Z, say); a file of a single channel or a single layer gives that one.
Result<std::vector<Channel>> plain_channels(const Layers& layers, ImageUse use) {
    if (const auto it = layers.find(""); it != layers.end()) {
        const auto is_rgb = [](const Channel& c) { return c.order >= kRed && c.order <= kBlue; };
        const bool rgb = std::ranges::any_of(it->second, is_rgb);
        if (!rgb && (has(it->second, "RY") || has(it->second, "BY")))
            return Error{"EXR in luminance and chroma (Y, RY, BY); convert it to R, G, B"};
        if (!rgb && use == ImageUse::color && has(it->second, "X") && has(it->second, "Y"))
            return Error{"EXR with channels X, Y, Z in place of a colour; convert it to R, G, B"};
        std::vector<Channel> named;
        for (const Channel& c : it->second)
            if (c.order != kOther && !(rgb && c.order == kLuminance)) named.push_back(c);
        const bool color = std::ranges::any_of(named, [](const Channel& c) { return c.order < kOther; });
        if (color) return named;
        if (it->second.size() <= 4) return it->second;
    }
    if (layers.size() == 1 && layers.begin()->second.size() <= 4) return layers.begin()->second;
    std::string names;
    for (const auto& [name, channels] : layers)
        for (const Channel& channel : channels) names += (names.empty() ? "" : ", ") + channel.name;
    return Error{"EXR without plain R, G, B, A or Y channels; it holds " + names.substr(0, 200)};
}

struct Target {
    Image image;
    std::vector<Channel> channels;
};

Result<Target> make_target(std::vector<Channel> channels, int width, int height) {
    if (channels.size() > 4)
        return Error{fmt::format("EXR layer of {} channels; dermis reads up to 4", channels.size())};
    const bool half = std::ranges::all_of(channels, [](const Channel& c) { return c.type == Imf::HALF; });
    const PixelFormat format = half ? PixelFormat::f16 : PixelFormat::f32;
    const int count = int(channels.size());
    DERMIS_TRY(check_image_size(uint64_t(width), uint64_t(height), count));
    return Target{Image(width, height, count, format, Encoding::linear), std::move(channels)};
}

void add_slices(Imf::FrameBuffer& buffer, Target& target, const Imath::Box2i& window) {
    const size_t value = bytes_per_channel(target.image.format);
    const size_t texel = value * size_t(target.image.channels);
    const Imf::PixelType type = value == 2 ? Imf::HALF : Imf::FLOAT;
    for (size_t c = 0; c < target.channels.size(); ++c)
        buffer.insert(target.channels[c].name,
                      Imf::Slice::Make(type, target.image.bytes.data() + c * value, window, texel,
                                       texel * size_t(target.image.width)));
}

Result<Image> in_display_window(Image data, const Imath::Box2i& window, const Imath::Box2i& display) {
    if (window == display) return data;
    const int x0 = std::max(window.min.x, display.min.x), x1 = std::min(window.max.x, display.max.x);
    const int y0 = std::max(window.min.y, display.min.y), y1 = std::min(window.max.y, display.max.y);
    if (x0 > x1 || y0 > y1) return Error{"EXR whose data window lies outside of its display window"};
    const int width = display.max.x - display.min.x + 1, height = display.max.y - display.min.y + 1;
    DERMIS_TRY(check_image_size(uint64_t(width), uint64_t(height), data.channels));
    Image picture(width, height, data.channels, data.format, data.encoding);
    const size_t texel = bytes_per_channel(data.format) * size_t(data.channels);
    for (int y = y0; y <= y1; ++y) {
        const size_t from = size_t(y - window.min.y) * size_t(data.width) + size_t(x0 - window.min.x);
        const size_t to = size_t(y - display.min.y) * size_t(width) + size_t(x0 - display.min.x);
        std::memcpy(picture.bytes.data() + to * texel, data.bytes.data() + from * texel,
                    size_t(x1 - x0 + 1) * texel);
    }
    return picture;
}

ImageText read_text(const Imf::Header& header) {
    ImageText text;
    for (auto it = header.begin(); it != header.end(); ++it)
        if (const auto* value = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
            text[it.name()] = value->value();
    // The name and the type of a part in a file of several do not describe the image.
    text.erase("name");
    text.erase("type");
    return text;
}

// `pick` turns the file's layers into named lists of channels. May throw what OpenEXR throws.
template <class Pick>
Result<LayeredImage> read_layers(Bytes bytes, Pick pick) {
    ExrInput stream(bytes);
    Imf::MultiPartInputFile file(stream, 0, false);
    Imf::InputPart part(file, 0);
    const Imath::Box2i window = part.header().dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    DERMIS_TRY_ASSIGN(Layers layers, collect_layers(part.header().channels()));
    DERMIS_TRY_ASSIGN(Layers picked, pick(layers));

    std::vector<Target> targets;
    Imf::FrameBuffer buffer;
    uint64_t total = 0;
    DERMIS_TRY_ASSIGN(const uint64_t limit, max_image_bytes());
    for (auto& [name, channels] : picked) {
        DERMIS_TRY_ASSIGN(Target target, make_target(std::move(channels), width, height));
        total += target.image.bytes.size();
        if (total > limit)
            return Error{fmt::format(
                "EXR whose layers take more than {} MiB, the limit (DERMIS_MAX_IMAGE_MIB)", limit >> 20)};
        targets.push_back(std::move(target));
        add_slices(buffer, targets.back(), window);
    }
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);

    LayeredImage out;
    out.text = read_text(part.header());
    size_t index = 0;
    for (const auto& [name, channels] : picked) {
        DERMIS_TRY_ASSIGN(Image picture, in_display_window(std::move(targets[index++].image), window,
                                                           part.header().displayWindow()));
        out.layers.push_back({name, std::move(picture)});
    }
    return out;
}

// OpenEXR reports errors, and failed allocations, by exceptions; none leaves this function.
template <class Pick>
Result<LayeredImage> read_guarded(Bytes file, Pick pick) {
    DERMIS_TRY(check_exr_header(file));
    try {
        return read_layers(file, pick);
    } catch (const std::exception& e) {
        return Error{std::string("corrupt EXR: ") + e.what()};
    }
}

}  // namespace

bool ExrInput::read(char to[], int count) {
    if (count < 0 || at_ > file_.size() || uint64_t(count) > file_.size() - at_)
        throw Iex::InputExc("the file ends early");
    std::memcpy(to, file_.data() + at_, size_t(count));
    at_ += uint64_t(count);
    return at_ < file_.size();
}

Result<LoadedImage> decode_exr(Bytes file, ImageUse use) {
    DERMIS_TRY_ASSIGN(LayeredImage read, read_guarded(file, [use](const Layers& layers) -> Result<Layers> {
                          DERMIS_TRY_ASSIGN(std::vector<Channel> plain, plain_channels(layers, use));
                          return Layers{{"", std::move(plain)}};
                      }));
    return LoadedImage{std::move(read.layers.front().image), std::move(read.text)};
}

Result<LayeredImage> decode_layered_exr(Bytes file) {
    return read_guarded(file, [](const Layers& layers) -> Result<Layers> { return layers; });
}

}  // namespace dermis::inline image::codec
