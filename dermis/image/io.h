#pragma once
// Image files; the content decides the format when reading, the extension when writing.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "dermis/image/image.h"

namespace dermis::inline image {

/// How to read a file's integers. Colour maps are sRGB unless the file says otherwise; normal maps,
/// roughness, curvature and tables are data. Float files are always linear.
enum class ImageUse { color, data };

/// Text inside a file (PNG iTXt, EXR header attributes): sidecar JSON, credit lines.
using ImageText = std::map<std::string, std::string>;

struct LoadedImage {
    Image image;
    ImageText text;
};

/// PNG (1 to 16 bit, palette; u8 or u16), JPEG (u8), Radiance HDR (f32), OpenEXR (any compression; f16 or
/// f32), DDS and KTX2 (uncompressed, the largest mip; swizzle and orientation as the file says). A 2048x2048
/// JPEG takes 15 to 45 ms, the same as PNG 80 ms. Errors name the file: unreadable, truncated, corrupt,
/// larger than check_image_size() allows, an unknown format.
[[nodiscard]] Result<LoadedImage> read_image(const std::filesystem::path& path, ImageUse use);
/// The same from memory (embedded glTF images); `name` names the image in errors.
[[nodiscard]] Result<LoadedImage> decode_image(std::span<const std::byte> bytes, std::string_view name,
                                               ImageUse use);

/// By extension: .png (u8 or u16 as the image is; f16 and f32 become u8 sRGB), .exr (f16 or f32 as the image
/// is; u8 becomes f16, u16 f32), .hdr (RGB), .dds and .ktx2 (RGBA16F, no mips). Written as by write_file().
/// All but PNG are linear. Where a format has more channels than the image, one channel is grey, two
/// are red and green, alpha is 1; .hdr drops alpha. PNG (iTXt), EXR (string attributes) and KTX2 (key/value
/// data) hold the text; .hdr and .dds leave it out. Text keys: plain ASCII, at most
/// 79 characters.
[[nodiscard]] Result<void> write_image(const std::filesystem::path& path, const Image& image,
                                       const ImageText& text = {});
/// The same into memory; `extension` is ".png", ".exr", ".hdr", ".dds" or ".ktx2".
[[nodiscard]] Result<std::vector<std::byte>> encode_image(std::string_view extension, const Image& image,
                                                          const ImageText& text = {});

/// A JPEG of one or three channels of 8 bits; `quality` 1 to 100. Colours (sRGB) have chroma of half the
/// resolution, data of full resolution. Errors: another kind of image.
[[nodiscard]] Result<std::vector<std::byte>> encode_jpeg(const Image& image, int quality);

/// One named part of a layered EXR; channels appear as "name.R", or plain "R" when the name is empty. One
/// channel is named Y, two R and G.
struct ImageLayer {
    std::string name;
    Image image;
};
[[nodiscard]] Result<void> write_layered_exr(const std::filesystem::path& path,
                                             std::span<const ImageLayer> layers, const ImageText& text = {});

struct LayeredImage {
    std::vector<ImageLayer> layers;
    ImageText text;
};
/// All layers of an EXR file's first part, by name. A layer is f16 if all its channels are, else f32;
/// channels in the order R G B, or Y, then others alphabetically (X Y Z), then A; at most four. The picture
/// is the display window. read_image takes the layer without a name.
[[nodiscard]] Result<LayeredImage> read_layered_exr(const std::filesystem::path& path);

}  // namespace dermis::inline image
