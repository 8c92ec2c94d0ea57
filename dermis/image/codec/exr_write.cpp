// OpenEXR writing: one part of scanlines, ZIP (lossless, 16 lines per block), every layer's channels in one
// list.

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <set>

#include "dermis/image/codec/exr.h"

namespace dermis::inline image::codec {
namespace {

std::string channel_name(const std::string& layer, int channels, int channel) {
    const char letter = channels == 1 ? 'Y' : "RGBA"[channel];
    return layer.empty() ? std::string(1, letter) : layer + "." + letter;
}

Result<void> check_layers(std::span<const ImageLayer> layers) {
    if (layers.empty()) return Error{"an EXR needs at least one layer"};
    std::set<std::string> names;
    for (const ImageLayer& layer : layers) {
        if (!names.insert(layer.name).second) return Error{"two layers are called '" + layer.name + "'"};
        if (layer.image.empty()) return Error{"the layer '" + layer.name + "' is empty"};
        if (layer.image.width != layers[0].image.width || layer.image.height != layers[0].image.height)
            return Error{"the layer '" + layer.name + "' is of another size than '" + layers[0].name + "'"};
    }
    return {};
}

// Attribute names that a header has or gives a meaning of its own.
Result<void> add_text(Imf::Header& header, const ImageText& text) {
    for (const auto& [key, value] : text) {
        if (header.find(key) != header.end() || key == "name" || key == "type" || key == "chunkCount" ||
            key == "tiles" || key == "view" || key == "version")
            return Error{"the text key '" + key + "' means something else in an EXR"};
        header.insert(key, Imf::StringAttribute(value));
    }
    return {};
}

Result<Buffer> write_layers(std::span<const ImageLayer> layers, const ImageText& text) {
    const int width = layers[0].image.width, height = layers[0].image.height;
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    DERMIS_TRY(add_text(header, text));

    Imf::FrameBuffer buffer;
    for (const auto& [name, image] : layers) {
        const size_t value = bytes_per_channel(image.format), texel = value * size_t(image.channels);
        const Imf::PixelType type = image.format == PixelFormat::f16 ? Imf::HALF : Imf::FLOAT;
        for (int c = 0; c < image.channels; ++c) {
            const std::string channel = channel_name(name, image.channels, c);
            header.channels().insert(channel, Imf::Channel(type));
            char* base =
                const_cast<char*>(reinterpret_cast<const char*>(image.bytes.data())) + size_t(c) * value;
            buffer.insert(channel, Imf::Slice(type, base, texel, texel * size_t(width)));
        }
    }
    ExrOutput stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(height);
    }  // the destructor fills in the chunk table
    return stream.finish();
}

}  // namespace

void ExrOutput::write(const char from[], int count) {
    const uint64_t end = at_ + uint64_t(count);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, from, size_t(count));
    at_ = end;
}

Result<Buffer> encode_exr(std::span<const ImageLayer> layers, const ImageText& text) {
    DERMIS_TRY(check_layers(layers));
    try {
        return write_layers(layers, text);
    } catch (const std::exception& e) {
        return Error{std::string("OpenEXR: ") + e.what()};
    }
}

}  // namespace dermis::inline image::codec
