#include "dermis/gpu/formats.h"

#include <algorithm>
#include <bit>

namespace dermis::gpu {

FormatInfo format_info(ImageFormat format) {
    constexpr VkImageAspectFlags kColor = VK_IMAGE_ASPECT_COLOR_BIT;
    switch (format) {
        case ImageFormat::r8:
            return {VK_FORMAT_R8_UNORM, kColor, 1, PixelFormat::u8};
        case ImageFormat::rg8:
            return {VK_FORMAT_R8G8_UNORM, kColor, 2, PixelFormat::u8};
        case ImageFormat::rgb10a2:  // four bytes; pictures are not read in it
            return {VK_FORMAT_A2B10G10R10_UNORM_PACK32, kColor, 4, PixelFormat::u8};
        case ImageFormat::rgba8:
            return {VK_FORMAT_R8G8B8A8_UNORM, kColor, 4, PixelFormat::u8};
        case ImageFormat::rgba16:
            return {VK_FORMAT_R16G16B16A16_UNORM, kColor, 4, PixelFormat::u16};
        case ImageFormat::r16f:
            return {VK_FORMAT_R16_SFLOAT, kColor, 1, PixelFormat::f16};
        case ImageFormat::rg16f:
            return {VK_FORMAT_R16G16_SFLOAT, kColor, 2, PixelFormat::f16};
        case ImageFormat::rgba16f:
            return {VK_FORMAT_R16G16B16A16_SFLOAT, kColor, 4, PixelFormat::f16};
        case ImageFormat::r32f:
            return {VK_FORMAT_R32_SFLOAT, kColor, 1, PixelFormat::f32};
        case ImageFormat::rgba32f:
            return {VK_FORMAT_R32G32B32A32_SFLOAT, kColor, 4, PixelFormat::f32};
        case ImageFormat::depth32f:
            return {VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT, 1, PixelFormat::f32};
    }
    return {};
}

int full_mip_count(int width, int height) {
    return std::bit_width(unsigned(std::max({width, height, 1})));
}

VkExtent2D mip_extent(VkExtent2D base, int mip) {
    return {std::max(1u, base.width >> mip), std::max(1u, base.height >> mip)};
}

}  // namespace dermis::gpu
