#include "dermis/image/io.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/codec/codec.h"

namespace dermis::inline image {
namespace {

// Magic numbers of the formats that a library reads.
bool starts_with(codec::Bytes file, std::string_view signature) {
    return file.size() >= signature.size() && !std::memcmp(file.data(), signature.data(), signature.size());
}
bool is_png(codec::Bytes file) {
    return starts_with(file, "\x89PNG\r\n\x1a\n");
}
bool is_jpeg(codec::Bytes file) {
    return starts_with(file, "\xff\xd8\xff");
}
bool is_exr(codec::Bytes file) {
    return starts_with(file, "\x76\x2f\x31\x01");
}

struct Decoder {
    bool (*matches)(codec::Bytes);
    Result<LoadedImage> (*decode)(codec::Bytes, ImageUse);
};
constexpr Decoder kDecoders[] = {
    {is_png, codec::decode_png},
    {is_jpeg, codec::decode_jpeg},
    {codec::is_radiance, codec::decode_radiance},
    {is_exr, codec::decode_exr},
    {codec::is_dds, codec::decode_dds},
    {codec::is_ktx2, codec::decode_ktx2},
};

// A message may quote names from the file, so it is reduced to one printable line.
template <class T>
Result<T> named(Result<T> result, std::string_view name) {
    if (result) return result;
    return Error{std::string(name) + ": " + printable_line(result.error().message)};
}

// One channel is grey, two are red and green (grey and alpha when sRGB-encoded), alpha is 1 where there is
// none.
Image with_channels(const Image& from, int channels) {
    if (from.channels == channels) return from;
    Image to(from.width, from.height, channels);
    const bool grey = from.channels == 1;
    for (size_t i = 0; i < from.pixel_count(); ++i)
        for (int c = 0; c < channels; ++c) {
            const float* texel = from.floats().data() + i * size_t(from.channels);
            const float missing = c == 3 ? 1.0f : grey ? texel[0] : 0.0f;
            to.floats()[i * size_t(channels) + size_t(c)] = c < from.channels ? texel[c] : missing;
        }
    return to;
}

// Expands grey and alpha first: only the sRGB encoding tells them from red and green.
Image linear_with_channels(const Image& image, int channels) {
    Image linear = to_linear_float(image);
    if (image.channels != 2 || alpha_channel(image) != 1) return with_channels(linear, channels);
    Image out(image.width, image.height, 4);
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        const float* texel = linear.floats().data() + 2 * i;
        for (size_t c = 0; c < 4; ++c) out.floats()[4 * i + c] = texel[c == 3 ? 1 : 0];
    }
    return with_channels(out, channels);
}

Image half_rgba(const Image& image) {
    if (image.format == PixelFormat::f16 && image.channels == 4 && image.encoding == Encoding::linear)
        return image;
    return convert(linear_with_channels(image, 4), PixelFormat::f16, Encoding::linear);
}

Image as_png(const Image& image) {
    if (image.format == PixelFormat::u8 || image.format == PixelFormat::u16) return image;
    return convert(to_linear_float(image), PixelFormat::u8, Encoding::srgb);
}

Image as_exr(const Image& image) {
    const bool is_float = image.format == PixelFormat::f16 || image.format == PixelFormat::f32;
    if (is_float && image.encoding == Encoding::linear) return image;
    const bool half = image.format == PixelFormat::u8 || image.format == PixelFormat::f16;
    const bool grey_alpha = image.channels == 2 && alpha_channel(image) == 1;
    return convert(linear_with_channels(image, grey_alpha ? 4 : image.channels),
                   half ? PixelFormat::f16 : PixelFormat::f32, Encoding::linear);
}

// PNG's rule for keywords (ISO/IEC 15948, 11.3.4.2), less the upper half of Latin-1; EXR and KTX2 accept
// these too.
Result<void> check_text(const ImageText& text) {
    for (const auto& [key, value] : text) {
        const bool plain = std::ranges::all_of(key, [](char c) { return c >= ' ' && c <= '~'; });
        if (!plain || key.empty() || key.size() > 79 || key.front() == ' ' || key.back() == ' ' ||
            key.find("  ") != std::string::npos)
            return Error{"the text key '" + key +
                         "' is not 1 to 79 plain ASCII characters with single spaces"};
        if (value.find('\0') != std::string::npos)
            return Error{"the text '" + key + "' has a zero byte in it"};
    }
    return {};
}

}  // namespace

Result<void> codec::check_ratio(uint64_t decoded_bytes, uint64_t file_bytes, uint64_t most) {
    if (decoded_bytes / most <= file_bytes) return {};
    return Error{fmt::format("is too short a file ({} bytes) for the {} bytes it claims to hold", file_bytes,
                             decoded_bytes)};
}

Result<LoadedImage> decode_image(std::span<const std::byte> bytes, std::string_view name, ImageUse use) {
    for (const Decoder& decoder : kDecoders)
        if (decoder.matches(bytes)) return named(decoder.decode(bytes, use), name);
    return Error{std::string(name) + (bytes.empty() ? ": is empty; an" : ": no known image format;") +
                 " image is PNG, JPEG, HDR, EXR, DDS or KTX2"};
}

Result<LoadedImage> read_image(const std::filesystem::path& path, ImageUse use) {
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
    return decode_image(bytes, path.string(), use);
}

Result<LayeredImage> read_layered_exr(const std::filesystem::path& path) {
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
    if (!is_exr(bytes)) return Error{path.string() + ": is not an EXR file"};
    return named(codec::decode_layered_exr(bytes), path.string());
}

Result<std::vector<std::byte>> encode_image(std::string_view extension, const Image& image,
                                            const ImageText& text) {
    if (image.empty()) return Error{"the image is empty"};
    DERMIS_TRY(check_text(text));
    const std::string type = to_lower(extension);
    if (type == ".png") return codec::encode_png(as_png(image), text);
    if (type == ".exr") return codec::encode_exr(std::array{ImageLayer{"", as_exr(image)}}, text);
    if (type == ".hdr") return codec::encode_radiance(linear_with_channels(image, 3));
    if (type == ".dds") return codec::encode_dds(half_rgba(image));
    if (type == ".ktx2") return codec::encode_ktx2(half_rgba(image), text);
    static const std::vector<std::string> known = {".png", ".exr", ".hdr", ".dds", ".ktx2"};
    return Error{unknown_name("image extension", extension, known)};
}

Result<void> write_image(const std::filesystem::path& path, const Image& image, const ImageText& text) {
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes,
                      named(encode_image(path.extension().string(), image, text), path.string()));
    return write_file(path, bytes);
}

Result<void> write_layered_exr(const std::filesystem::path& path, std::span<const ImageLayer> layers,
                               const ImageText& text) {
    if (Result<void> valid = check_text(text); !valid)
        return Error{path.string() + ": " + valid.error().message};
    std::vector<ImageLayer> linear;
    for (const ImageLayer& layer : layers) linear.push_back({layer.name, as_exr(layer.image)});
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes,
                      named(codec::encode_exr(linear, text), path.string()));
    return write_file(path, bytes);
}

}  // namespace dermis::inline image
