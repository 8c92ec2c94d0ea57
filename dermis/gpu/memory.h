#pragma once
// Buffers and images with their memory: one allocation each.

#include "dermis/gpu/formats.h"

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

}  // namespace dermis::gpu
