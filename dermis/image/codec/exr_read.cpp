// OpenEXR reading: any compression, scanlines or tiles (the largest level), the first part of several.

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>

#include <Iex.h>

#include <algorithm>
#include <map>

#include "dermis/image/codec/exr.h"

namespace dermis::codec {
namespace {

struct Channel {
    std::string name;        // in the file
    std::string short_name;  // after the last dot
    Imf::PixelType type;
};
using Layers = std::map<std::string, std::vector<Channel>>;

// R G B A, or Y A, come in that order; any others (X Y Z, U V) alphabetically after them.
constexpr int kOther = 5;
int order_of(const std::string& short_name) {
    const size_t place = std::string_view("YRGBA").find(short_name);
    return short_name.size() == 1 && place != std::string_view::npos ? int(place) : kOther;
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
    for (auto& [name, channels] : layers)
        std::ranges::stable_sort(channels, {}, [](const Channel& c) { return order_of(c.short_name); });
    return layers;
}

// Without a layer name: R G B A or Y A where there are any, whatever else the file holds beside them (a depth
// Z, say); a file of a single channel or a single layer gives that one.
Result<std::vector<Channel>> plain_channels(const Layers& layers) {
    if (const auto it = layers.find(""); it != layers.end()) {
        const auto is_rgb = [](const Channel& c) {
            return order_of(c.short_name) >= 1 && order_of(c.short_name) <= 3;
        };
        const bool rgb = std::ranges::any_of(it->second, is_rgb);
        std::vector<Channel> named;
        for (const Channel& c : it->second)
            if (order_of(c.short_name) < kOther && !(rgb && c.short_name == "Y")) named.push_back(c);
        if (!named.empty()) return named;
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
        return Error{"EXR layer of " + std::to_string(channels.size()) + " channels; dermis reads up to 4"};
    const bool half = std::ranges::all_of(channels, [](const Channel& c) { return c.type == Imf::HALF; });
    const PixelFormat format = half ? PixelFormat::f16 : PixelFormat::f32;
    const int count = int(channels.size());
    if (Result<void> size = check_image_size(uint64_t(width), uint64_t(height), count, format); !size)
        return size.error();
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

ImageText read_text(const Imf::Header& header) {
    ImageText text;
    for (auto it = header.begin(); it != header.end(); ++it)
        if (const auto* value = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
            text[it.name()] = value->value();
    // What a part of a file of several is called and how it is stored is no text about the image.
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
    Result<Layers> layers = collect_layers(part.header().channels());
    if (!layers) return layers.error();
    Result<Layers> picked = pick(*layers);
    if (!picked) return picked.error();

    std::vector<Target> targets;
    Imf::FrameBuffer buffer;
    uint64_t total = 0;
    for (auto& [name, channels] : *picked) {
        Result<Target> target = make_target(std::move(channels), width, height);
        if (!target) return target.error();
        total += target->image.bytes.size();
        if (total > kMaxImageBytes) return Error{"EXR whose layers take more than 2 GiB"};
        targets.push_back(*std::move(target));
        add_slices(buffer, targets.back(), window);
    }
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);

    LayeredImage out;
    out.text = read_text(part.header());
    size_t index = 0;
    for (const auto& [name, channels] : *picked)
        out.layers.push_back({name, std::move(targets[index++].image)});
    return out;
}

// OpenEXR reports by exceptions, and allocates; neither leaves.
template <class Pick>
Result<LayeredImage> read_guarded(Bytes file, Pick pick) {
    if (Result<void> fine = check_exr_header(file); !fine) return fine.error();
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

bool is_exr(Bytes file) {
    constexpr uint32_t kMagic = 20000630;
    return ByteReader(file).u32() == kMagic;
}

Result<LoadedImage> decode_exr(Bytes file, ImageUse) {
    Result<LayeredImage> read = read_guarded(file, [](const Layers& layers) -> Result<Layers> {
        Result<std::vector<Channel>> plain = plain_channels(layers);
        if (!plain) return plain.error();
        return Layers{{"", *std::move(plain)}};
    });
    if (!read) return read.error();
    return LoadedImage{std::move(read->layers.front().image), std::move(read->text)};
}

Result<LayeredImage> decode_layered_exr(Bytes file) {
    return read_guarded(file, [](const Layers& layers) -> Result<Layers> { return layers; });
}

}  // namespace dermis::codec
