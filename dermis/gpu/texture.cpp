#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "dermis/gpu/texture_state.h"

namespace dermis::gpu {
namespace {

Error texture_error(const TextureData& data, const std::string& what) {
    return Error{"texture '" + data.name + "': " + what};
}

size_t expected_bytes(const TextureData& data, int mips) {
    size_t texels = 0;
    for (int mip = 0; mip < mips; ++mip) {
        const VkExtent2D extent = mip_extent({uint32_t(data.width), uint32_t(data.height)}, mip);
        texels += size_t(extent.width) * extent.height * size_t(data.layers);
    }
    return texels * bytes_per_texel(data.format);
}

Result<void> check_data(const TextureData& data, const Context& context) {
    const int limit = int(context.properties.limits.maxImageDimension2D);
    if (data.width < 1 || data.height < 1 || data.width > limit || data.height > limit)
        return texture_error(
            data, fmt::format("size {}x{}; each side must be 1 to {}", data.width, data.height, limit));
    if (data.layers < 1 || (data.cube && data.layers != 6) || (data.cube && data.width != data.height))
        return texture_error(data, "a cube has six square layers, others at least one");
    if (data.mips < 1 || data.mips > full_mip_count(data.width, data.height))
        return texture_error(data, fmt::format("has {} mip levels; 1 to {}", data.mips,
                                               full_mip_count(data.width, data.height)));
    if (data.generate_mips && data.mips != 1)
        return texture_error(data, "bytes must hold level 0 only when mips are generated");
    if (data.srgb && data.format != ImageFormat::rgba8) return texture_error(data, "only rgba8 can be sRGB");
    constexpr VkFormatFeatureFlags kBlit = VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                           VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (data.generate_mips && !context.can(format_info(data.format).format, kBlit))
        return texture_error(data, fmt::format("this device cannot generate mips of {}; supply them",
                                               format_name(data.format)));
    if (data.bytes.size() != expected_bytes(data, data.mips))
        return texture_error(data, fmt::format("has {} bytes instead of {}", data.bytes.size(),
                                               expected_bytes(data, data.mips)));
    return {};
}

ImageInfo image_info(const TextureData& data) {
    const FormatInfo format = format_info(data.format);
    const int mips = data.generate_mips ? full_mip_count(data.width, data.height) : data.mips;
    return {.format = data.srgb ? VK_FORMAT_R8G8B8A8_SRGB : format.format,
            .aspect = format.aspect,
            .extent = {uint32_t(data.width), uint32_t(data.height)},
            .mips = uint32_t(mips),
            .layers = uint32_t(data.layers),
            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                     (data.generate_mips ? VkImageUsageFlags{VK_IMAGE_USAGE_TRANSFER_SRC_BIT} : 0),
            .cube = data.cube};
}

// Rows of a level, or all of it where it has layers, by where they lie in the data.
struct Strip {
    VkBufferImageCopy region;  // its offset is set when it is copied
    size_t begin = 0, bytes = 0;
};

// Limit of the staging buffer, unless one strip is larger: a map of 16384 x 16384 texels takes 1 GiB.
constexpr size_t kStagingBytes = size_t{32} << 20;

std::vector<Strip> strips_of(const TextureData& data, const ImageInfo& info) {
    std::vector<Strip> strips;
    size_t begin = 0;
    for (int mip = 0; mip < data.mips; ++mip) {
        const VkExtent2D extent = mip_extent(info.extent, mip);
        const size_t row = size_t(extent.width) * info.layers * bytes_per_texel(data.format);
        const auto affordable = uint32_t(std::clamp<size_t>(kStagingBytes / row, 1, extent.height));
        const uint32_t rows = info.layers > 1 ? extent.height : affordable;
        for (uint32_t y = 0; y < extent.height; y += rows) {
            const uint32_t height = std::min(rows, extent.height - y);
            strips.push_back({.region = {.imageSubresource = {info.aspect, uint32_t(mip), 0, info.layers},
                                         .imageOffset = {0, int32_t(y), 0},
                                         .imageExtent = {extent.width, height, 1}},
                              .begin = begin,
                              .bytes = row * height});
            begin += row * height;
        }
    }
    return strips;
}

// The strips that fit into the staging buffer at once, from the first of `strips` on.
std::span<Strip> first_batch(std::span<Strip> strips, size_t staging_bytes) {
    size_t count = 0, used = 0;
    for (; count < strips.size() && used + strips[count].bytes <= staging_bytes; ++count) {
        strips[count].region.bufferOffset = used;
        used += strips[count].bytes;
    }
    return strips.first(count);
}

void finish_mips(const Context& context, VkCommandBuffer commands, const TextureData& data,
                 const DeviceImage& image) {
    constexpr VkImageLayout kDestination = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    constexpr VkImageLayout kSource = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout kSampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const uint32_t mips = image.info.mips, generated = data.generate_mips ? mips - 1 : 0;
    for (uint32_t mip = 1; mip <= generated; ++mip) {
        transition(context, commands, image, mip - 1, 1, kDestination, kSource);
        blit_mip(context, commands, image, mip);
    }
    if (generated) transition(context, commands, image, 0, generated, kSource, kSampled);
    transition(context, commands, image, generated, mips - generated, kDestination, kSampled);
}

Result<void> copy_strips(Device& device, const TextureData& data, const DeviceImage& image) {
    const Context& context = device.state().context;
    std::vector<Strip> strips = strips_of(data, image.info);
    const size_t largest = std::ranges::max(strips, {}, &Strip::bytes).bytes;
    const size_t staging_bytes = std::min(std::max(kStagingBytes, largest), data.bytes.size());
    DERMIS_TRY_ASSIGN(Buffer staging, make_buffer(context, "staging " + data.name, staging_bytes,
                                                  VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload));
    for (std::span<Strip> rest = strips; !rest.empty();) {
        const std::span<Strip> batch = first_batch(rest, staging_bytes);
        for (const Strip& strip : batch)
            std::memcpy(static_cast<std::byte*>(staging.mapped) + strip.region.bufferOffset,
                        data.bytes.data() + strip.begin, strip.bytes);
        const bool is_first = rest.size() == strips.size(), is_last = rest.size() == batch.size();
        DERMIS_TRY(run_once(device.state(), "the upload of " + data.name, [&](VkCommandBuffer commands) {
            if (is_first)
                transition(context, commands, image, 0, image.info.mips, VK_IMAGE_LAYOUT_UNDEFINED,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
            for (const Strip& strip : batch)
                context.vk.vkCmdCopyBufferToImage(commands, staging.handle.get(), image.handle.get(),
                                                  VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &strip.region);
            if (is_last) finish_mips(context, commands, data, image);
        }));
        rest = rest.subspan(batch.size());
    }
    return {};
}

}  // namespace

void transition(const Context& context, VkCommandBuffer commands, const DeviceImage& image,
                uint32_t first_mip, uint32_t mips, VkImageLayout from, VkImageLayout to) {
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .image = image.handle.get(),
        .subresourceRange = {image.info.aspect, first_mip, mips, 0, image.info.layers}};
    const VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                         .imageMemoryBarrierCount = 1,
                                         .pImageMemoryBarriers = &barrier};
    context.vk.vkCmdPipelineBarrier2(commands, &dependency);
}

void blit_mip(const Context& context, VkCommandBuffer commands, const DeviceImage& image, uint32_t mip) {
    const VkExtent2D from = mip_extent(image.info.extent, int(mip) - 1);
    const VkExtent2D to = mip_extent(image.info.extent, int(mip));
    const VkImageBlit region = {.srcSubresource = {image.info.aspect, mip - 1, 0, image.info.layers},
                                .srcOffsets = {{}, {int32_t(from.width), int32_t(from.height), 1}},
                                .dstSubresource = {image.info.aspect, mip, 0, image.info.layers},
                                .dstOffsets = {{}, {int32_t(to.width), int32_t(to.height), 1}}};
    context.vk.vkCmdBlitImage(commands, image.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                              image.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                              VK_FILTER_LINEAR);
}

Result<Texture> Texture::upload(Device& device, const TextureData& data) {
    const Context& context = device.state().context;
    DERMIS_TRY(check_data(data, context));
    DERMIS_TRY_ASSIGN(DeviceImage image, make_image(context, data.name, image_info(data)));
    DERMIS_TRY(copy_strips(device, data, image));
    auto state = std::make_unique<State>();
    state->image = std::move(image);
    state->name = data.name;
    state->bytes_per_texel = dermis::bytes_per_texel(data.format);
    state->sampler = device.state().map_sampler(data.address_u, data.address_v);
    return Texture(std::move(state));
}

uint64_t Texture::bytes() const {
    const ImageInfo& info = state_->image.info;
    return uint64_t(info.extent.width) * info.extent.height * info.layers * state_->bytes_per_texel;
}

size_t Texture::bytes_per_texel() const {
    return state_->bytes_per_texel;
}

Texture::Texture(std::unique_ptr<State> state) : state_(std::move(state)) {}
Texture::~Texture() = default;
Texture::Texture(Texture&&) noexcept = default;
Texture& Texture::operator=(Texture&&) noexcept = default;

}  // namespace dermis::gpu
