#pragma once
// The state behind the handles Texture and Geometry.

#include <map>

#include "dermis/gpu/device_state.h"

namespace dermis::gpu {

struct Texture::State {
    DeviceImage image;  ///< always in SHADER_READ_ONLY_OPTIMAL
    std::string name;
    size_t bytes_per_texel = 0;
    VkSampler sampler = VK_NULL_HANDLE;  ///< the device's, trilinear with the texture's address modes
};

/// On the device, or as bytes that go along with each frame.
struct GeometryData {
    Buffer buffer;
    std::vector<std::byte> bytes;
};

struct Array::State {
    GeometryData data;
};

struct Geometry::State {
    struct Stream {
        int components = 0;
        GeometryData data;
    };
    std::string name;
    std::map<std::string, Stream, std::less<>> streams;
    GeometryData indices;
    uint32_t index_count = 0, vertex_count = 0;
};

/// A device buffer with these bytes, through staging.
[[nodiscard]] Result<Buffer> upload_buffer(Device::State& device, std::string_view name,
                                           VkBufferUsageFlags usage, std::span<const std::byte> bytes);

/// Whole-image transition of `mips` levels from `first_mip` in a one-time command buffer, all stages.
void transition(const Context& context, VkCommandBuffer commands, const DeviceImage& image,
                uint32_t first_mip, uint32_t mips, VkImageLayout from, VkImageLayout to);

/// Level `mip` from level `mip - 1` by one blit, all layers; both must be in their transfer layouts.
void blit_mip(const Context& context, VkCommandBuffer commands, const DeviceImage& image, uint32_t mip);

}  // namespace dermis::gpu
