// Brings stored texels into the order of channels, columns and rows of Image.

#include "dermis/image/codec/texel_format.h"

#include <cstring>
#include <string>

namespace dermis::inline image::codec {
namespace {

constexpr std::string_view kNames = "rgba";

// The bytes of the value 1.
std::array<std::byte, 4> one_in(PixelFormat format) {
    Image one(1, 1, 1, format);
    one.set(0, 0, 0, 1);
    std::array<std::byte, 4> bytes{};
    std::memcpy(bytes.data(), one.bytes.data(), one.bytes.size());
    return bytes;
}

// "rgb1" and "rgba" are the same for three channels.
char meaning(char c, int channels) {
    const size_t stored = kNames.find(c);
    if (stored == std::string_view::npos || int(stored) < channels) return c;
    return c == 'a' ? '1' : '0';
}

}  // namespace

Result<Image> apply_swizzle(Image stored, std::string_view swizzle) {
    std::array<char, 4> from{};
    bool changes = false;
    for (size_t c = 0; c < 4; ++c) {
        if (swizzle.size() != 4 || std::string_view("rgba01").find(swizzle[c]) == std::string_view::npos)
            return Error{"the swizzle '" + std::string(swizzle.substr(0, 20)) + "' is not four of rgba01"};
        from[c] = meaning(swizzle[c], stored.channels);
        changes |= from[c] != meaning(kNames[c], stored.channels);
        const bool mixes = (c == 3) == (from[c] == 'r' || from[c] == 'g' || from[c] == 'b') &&
                           from[c] != '0' && from[c] != '1';
        if (mixes && stored.encoding == Encoding::srgb)
            return Error{"the swizzle '" + std::string(swizzle) +
                         "' takes alpha for an sRGB colour or the reverse, which is not supported"};
    }
    if (!changes) return stored;
    Image image(stored.width, stored.height, from[3] == '1' ? 3 : 4, stored.format, stored.encoding);
    const size_t value = bytes_per_channel(stored.format);
    const std::array<std::byte, 4> one = one_in(stored.format);
    const auto channels = size_t(image.channels), stored_channels = size_t(stored.channels);
    for (size_t i = 0; i < image.pixel_count(); ++i)
        for (size_t c = 0; c < channels; ++c) {
            if (from[c] == '0') continue;
            const std::byte* source =
                from[c] == '1' ? one.data()
                               : stored.bytes.data() + (i * stored_channels + kNames.find(from[c])) * value;
            std::memcpy(image.bytes.data() + (i * channels + c) * value, source, value);
        }
    return image;
}

Image mirror_columns(const Image& image) {
    Image mirrored = image;
    const size_t texel = bytes_per_channel(image.format) * size_t(image.channels);
    const auto width = size_t(image.width);
    for (size_t row = 0; row < size_t(image.height); ++row)
        for (size_t x = 0; x < width; ++x)
            std::memcpy(mirrored.bytes.data() + (row * width + x) * texel,
                        image.bytes.data() + (row * width + width - 1 - x) * texel, texel);
    return mirrored;
}

Image mirror_rows(const Image& image) {
    Image mirrored = image;
    const size_t row = bytes_per_channel(image.format) * size_t(image.channels) * size_t(image.width);
    const auto height = size_t(image.height);
    for (size_t y = 0; y < height; ++y)
        std::memcpy(mirrored.bytes.data() + y * row, image.bytes.data() + (height - 1 - y) * row, row);
    return mirrored;
}

}  // namespace dermis::inline image::codec
