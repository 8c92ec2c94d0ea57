#pragma once
// ImageFormat in Vulkan's terms and in those of dermis/image.

#include "dermis/gpu/vulkan.h"
#include "dermis/image/image.h"
#include "dermis/technique/pass_list.h"

namespace dermis::gpu {

struct FormatInfo {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    int channels = 0;
    PixelFormat pixel = PixelFormat::f32;  ///< of one channel, when read back
};

[[nodiscard]] FormatInfo format_info(ImageFormat format);
[[nodiscard]] inline bool is_depth(ImageFormat format) {
    return format == ImageFormat::depth32f;
}

/// Levels of a full chain: 1 + floor(log2(larger side)).
[[nodiscard]] int full_mip_count(int width, int height);
/// Size of a level; never below 1.
[[nodiscard]] VkExtent2D mip_extent(VkExtent2D base, int mip);

}  // namespace dermis::gpu
