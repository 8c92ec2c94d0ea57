#pragma once
// Inside dermis/image only: the uncompressed texel formats that DDS and KTX2 files carry, in one table.

#include <array>
#include <cstdint>

#include "dermis/image/image.h"

namespace dermis::codec {

struct TexelFormat {
    uint32_t dxgi;    // DXGI_FORMAT, 0: none
    uint32_t vulkan;  // VkFormat
    PixelFormat format;
    int channels;
    Encoding encoding;
};

inline constexpr std::array kTexelFormats = {
    TexelFormat{61, 9, PixelFormat::u8, 1, Encoding::linear},     // R8_UNORM
    TexelFormat{49, 16, PixelFormat::u8, 2, Encoding::linear},    // R8G8_UNORM
    TexelFormat{28, 37, PixelFormat::u8, 4, Encoding::linear},    // R8G8B8A8_UNORM
    TexelFormat{29, 43, PixelFormat::u8, 4, Encoding::srgb},      // R8G8B8A8_SRGB
    TexelFormat{56, 70, PixelFormat::u16, 1, Encoding::linear},   // R16_UNORM
    TexelFormat{35, 77, PixelFormat::u16, 2, Encoding::linear},   // R16G16_UNORM
    TexelFormat{11, 91, PixelFormat::u16, 4, Encoding::linear},   // R16G16B16A16_UNORM
    TexelFormat{54, 76, PixelFormat::f16, 1, Encoding::linear},   // R16_SFLOAT
    TexelFormat{34, 83, PixelFormat::f16, 2, Encoding::linear},   // R16G16_SFLOAT
    TexelFormat{10, 97, PixelFormat::f16, 4, Encoding::linear},   // R16G16B16A16_SFLOAT
    TexelFormat{41, 100, PixelFormat::f32, 1, Encoding::linear},  // R32_SFLOAT
    TexelFormat{16, 103, PixelFormat::f32, 2, Encoding::linear},  // R32G32_SFLOAT
    TexelFormat{6, 106, PixelFormat::f32, 3, Encoding::linear},   // R32G32B32_SFLOAT
    TexelFormat{2, 109, PixelFormat::f32, 4, Encoding::linear},   // R32G32B32A32_SFLOAT
};

inline constexpr uint32_t kDxgiRgba16Float = 10, kVulkanRgba16Float = 97;

inline const TexelFormat* find_dxgi(uint32_t dxgi) {
    for (const TexelFormat& f : kTexelFormats)
        if (f.dxgi == dxgi) return &f;
    return nullptr;
}
inline const TexelFormat* find_vulkan(uint32_t vulkan) {
    for (const TexelFormat& f : kTexelFormats)
        if (f.vulkan == vulkan) return &f;
    return nullptr;
}

}  // namespace dermis::codec
