#pragma once
// Buffers and images with their memory: one allocation each.

#include "dermis/gpu/vulkan.h"
#include "dermis/image/image.h"
#include "dermis/technique/pass_list.h"

namespace dermis::gpu {

/// device: fast for the GPU, not mapped. upload: written by the CPU, mapped. readback: read by the CPU,
/// mapped and cached where possible. Mapped memory is coherent.
enum class MemoryUse { device, upload, readback };

struct Buffer {
    OwnedMemory memory;
    OwnedBuffer handle;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr;  ///< null for MemoryUse::device
};

[[nodiscard]] Result<Buffer> make_buffer(const Context& context, std::string_view name, VkDeviceSize size,
                                         VkBufferUsageFlags usage, MemoryUse use);

struct ImageInfo {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    VkExtent2D extent = {1, 1};
    uint32_t mips = 1, layers = 1, samples = 1;
    VkImageUsageFlags usage = 0;
    bool cube = false;
};

struct DeviceImage {
    OwnedMemory memory;
    OwnedImage handle;
    OwnedView view;  ///< all mips, all layers
    ImageInfo info;
};

[[nodiscard]] Result<DeviceImage> make_image(const Context& context, std::string_view name,
                                             const ImageInfo& info);

/// A 2D view of one level.
[[nodiscard]] Result<OwnedView> make_mip_view(const Context& context, const DeviceImage& image, uint32_t mip);

// ImageFormat in Vulkan's terms and in those of dermis/image.

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
