#pragma once
// Inside dermis/image only: the uncompressed texel formats that DDS and KTX2 files carry, in one table.

#include <array>
#include <cstdint>
#include <string_view>

#include "dermis/image/image.h"

namespace dermis::inline image::codec {

struct TexelFormat {
    uint32_t dxgi;    // DXGI_FORMAT, 0: none
    uint32_t vulkan;  // VkFormat, 0: none
    PixelFormat format;
    int channels;
    Encoding encoding;
    const char* swizzle = "rgba";  // of the stored channels, see apply_swizzle
};

inline constexpr std::array kTexelFormats = {
    TexelFormat{61, 9, PixelFormat::u8, 1, Encoding::linear},           // R8_UNORM
    TexelFormat{0, 15, PixelFormat::u8, 1, Encoding::srgb},             // R8_SRGB
    TexelFormat{49, 16, PixelFormat::u8, 2, Encoding::linear},          // R8G8_UNORM
    TexelFormat{0, 23, PixelFormat::u8, 3, Encoding::linear},           // R8G8B8_UNORM
    TexelFormat{0, 29, PixelFormat::u8, 3, Encoding::srgb},             // R8G8B8_SRGB
    TexelFormat{0, 30, PixelFormat::u8, 3, Encoding::linear, "bgr1"},   // B8G8R8_UNORM
    TexelFormat{0, 36, PixelFormat::u8, 3, Encoding::srgb, "bgr1"},     // B8G8R8_SRGB
    TexelFormat{28, 37, PixelFormat::u8, 4, Encoding::linear},          // R8G8B8A8_UNORM
    TexelFormat{29, 43, PixelFormat::u8, 4, Encoding::srgb},            // R8G8B8A8_SRGB
    TexelFormat{87, 44, PixelFormat::u8, 4, Encoding::linear, "bgra"},  // B8G8R8A8_UNORM
    TexelFormat{91, 50, PixelFormat::u8, 4, Encoding::srgb, "bgra"},    // B8G8R8A8_SRGB
    TexelFormat{88, 0, PixelFormat::u8, 4, Encoding::linear, "bgr1"},   // B8G8R8X8_UNORM
    TexelFormat{93, 0, PixelFormat::u8, 4, Encoding::srgb, "bgr1"},     // B8G8R8X8_SRGB
    TexelFormat{56, 70, PixelFormat::u16, 1, Encoding::linear},         // R16_UNORM
    TexelFormat{35, 77, PixelFormat::u16, 2, Encoding::linear},         // R16G16_UNORM
    TexelFormat{0, 84, PixelFormat::u16, 3, Encoding::linear},          // R16G16B16_UNORM
    TexelFormat{11, 91, PixelFormat::u16, 4, Encoding::linear},         // R16G16B16A16_UNORM
    TexelFormat{54, 76, PixelFormat::f16, 1, Encoding::linear},         // R16_SFLOAT
    TexelFormat{34, 83, PixelFormat::f16, 2, Encoding::linear},         // R16G16_SFLOAT
    TexelFormat{0, 90, PixelFormat::f16, 3, Encoding::linear},          // R16G16B16_SFLOAT
    TexelFormat{10, 97, PixelFormat::f16, 4, Encoding::linear},         // R16G16B16A16_SFLOAT
    TexelFormat{41, 100, PixelFormat::f32, 1, Encoding::linear},        // R32_SFLOAT
    TexelFormat{16, 103, PixelFormat::f32, 2, Encoding::linear},        // R32G32_SFLOAT
    TexelFormat{6, 106, PixelFormat::f32, 3, Encoding::linear},         // R32G32B32_SFLOAT
    TexelFormat{2, 109, PixelFormat::f32, 4, Encoding::linear},         // R32G32B32A32_SFLOAT
};

/// The supported formats, for messages about others.
inline constexpr const char* kReadTexelFormats =
    "dermis reads uncompressed 1 to 4 channels of 8 or 16 bits or floats (not signed, not packed)";

inline constexpr uint32_t kDxgiRgba16Float = 10, kDxgiRgba32Float = 2, kVulkanRgba16Float = 97;

inline const TexelFormat* find_dxgi(uint32_t dxgi) {
    for (const TexelFormat& f : kTexelFormats)
        if (dxgi != 0 && f.dxgi == dxgi) return &f;
    return nullptr;
}
inline const TexelFormat* find_vulkan(uint32_t vulkan) {
    for (const TexelFormat& f : kTexelFormats)
        if (vulkan != 0 && f.vulkan == vulkan) return &f;
    return nullptr;
}

/// The channels of an image from those that are stored: for red, green, blue and alpha one of "rgba01". A
/// stored channel that does not exist is 0, alpha 1. The result has the image's own channels where the
/// swizzle changes nothing, else three or, unless alpha is "1", four. An error when sRGB-encoded colour and
/// alpha, which is linear, change places.
[[nodiscard]] Result<Image> apply_swizzle(Image stored, std::string_view swizzle);

/// Columns and rows in reverse order.
[[nodiscard]] Image mirror_columns(const Image& image);
[[nodiscard]] Image mirror_rows(const Image& image);

}  // namespace dermis::inline image::codec
