#pragma once
// Image files, told apart by content when reading and by extension when writing.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "dermis/image/image.h"

namespace dermis {

/// How a file's integers are to be taken. Colour maps are sRGB unless the file says otherwise; normal maps,
/// roughness, curvature and tables are data. Float files are always linear.
enum class ImageUse { color, data };

/// Text that travels inside a file (PNG iTXt, EXR header attributes): sidecar JSON, credit lines.
using ImageText = std::map<std::string, std::string>;

struct LoadedImage {
    Image image;
    ImageText text;
};

/// PNG (1 to 16 bit, palette), JPEG, Radiance HDR, OpenEXR (any compression), DDS and KTX2 (uncompressed).
/// Errors name the file: unreadable, truncated, corrupt, a side over kMaxImageSide, an unknown format.
[[nodiscard]] Result<LoadedImage> read_image(const std::filesystem::path& path, ImageUse use);
/// The same from memory (embedded glTF images); `name` stands in errors.
[[nodiscard]] Result<LoadedImage> decode_image(std::span<const std::byte> bytes, std::string_view name,
                                               ImageUse use);

/// By extension: .png (u8 or u16 as the image is; f32 becomes u8 sRGB), .exr (f16 or f32 as the image is),
/// .hdr, .dds and .ktx2 (RGBA16F). Written beside and renamed.
[[nodiscard]] Result<void> write_image(const std::filesystem::path& path, const Image& image,
                                       const ImageText& text = {});

/// One named part of a layered EXR; channels appear as "name.R", or plain "R" when the name is empty.
struct ImageLayer {
    std::string name;
    Image image;
};
[[nodiscard]] Result<void> write_layered_exr(const std::filesystem::path& path,
                                             std::span<const ImageLayer> layers, const ImageText& text = {});

}  // namespace dermis
