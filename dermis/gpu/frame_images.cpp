#include "dermis/gpu/frame_images.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "dermis/base/text.h"

namespace dermis::gpu {
namespace {

// Images that no list used for so many runs are freed: lists that alternate keep theirs, and resizing a
// window does not fill the memory.
constexpr uint64_t kIdleImageRuns = 8;

bool is_storage(const PassList& list, std::string_view name) {
    return std::ranges::any_of(list.passes, [&](const Pass& pass) {
        return std::ranges::any_of(pass.storage, [&](const ImageRead& image) { return image.image == name; });
    });
}

std::string image_key(const ImageDeclaration& declaration, VkExtent2D extent, bool storage) {
    return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}", declaration.name, int(declaration.format), extent.width,
                       extent.height, declaration.samples, declaration.mips, declaration.persistent, storage);
}

}  // namespace

Result<void> FrameImages::prepare(const PassList& list, int width, int height) {
    ++run_;
    current_.clear();
    for (const ImageDeclaration& declaration : list.images) {
        const TexelSize size = size_in_frame(declaration.size, width, height);
        const VkExtent2D extent = {uint32_t(size.width), uint32_t(size.height)};
        const bool storage = is_storage(list, declaration.name);
        const std::string key = image_key(declaration, extent, storage);
        auto found = images_.find(key);
        if (found == images_.end()) {
            DERMIS_TRY_ASSIGN(FrameImage image, make(declaration, extent, storage));
            found = images_.emplace(key, std::move(image)).first;
            if (declaration.persistent) DERMIS_TRY(clear(found->second));
        }
        found->second.last_run = run_;
        current_[declaration.name] = &found->second;
    }
    std::erase_if(images_, [&](const auto& entry) { return entry.second.last_run + kIdleImageRuns < run_; });
    return {};
}

FrameImage* FrameImages::find(std::string_view name) const {
    const auto found = current_.find(name);
    return found == current_.end() ? nullptr : found->second;
}

std::vector<std::string> FrameImages::names() const {
    std::vector<std::string> names;
    for (const auto& [name, image] : current_) names.push_back(name);
    return names;
}

uint64_t FrameImages::bytes() const {
    uint64_t bytes = 0;
    for (const auto& [key, image] : images_)
        for (uint32_t mip = 0; mip < image.image.info.mips; ++mip) {
            const VkExtent2D extent = image.extent(int(mip));
            bytes += uint64_t(extent.width) * extent.height * image.image.info.samples *
                     bytes_per_texel(image.declaration.format);
        }
    return bytes;
}

Result<FrameImage> FrameImages::make(const ImageDeclaration& declaration, VkExtent2D extent, bool storage) {
    const Context& context = device_->context;
    if (!(context.sample_counts & uint32_t(declaration.samples)))
        return Error{fmt::format("image '{}': {} has no {} samples", declaration.name, device_->info.name,
                                 declaration.samples)};
    const FormatInfo format = format_info(declaration.format);
    const int chain = full_mip_count(int(extent.width), int(extent.height));
    if (declaration.mips < 0 || declaration.mips > chain)
        return Error{fmt::format("image '{}' has {} mip levels; at most {}, 0 for all", declaration.name,
                                 declaration.mips, chain)};
    if (declaration.samples > 1 && (declaration.mips != 1 || storage))
        return Error{"image '" + declaration.name +
                     "' is multisampled; such images have neither mips nor storage writes"};
    VkImageUsageFlags usage =
        VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    usage |= is_depth(declaration.format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                          : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (storage) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    DERMIS_TRY_ASSIGN(DeviceImage image,
                      make_image(context, declaration.name,
                                 {.format = format.format,
                                  .aspect = format.aspect,
                                  .extent = extent,
                                  .mips = uint32_t(declaration.mips ? declaration.mips : chain),
                                  .samples = uint32_t(declaration.samples),
                                  .usage = usage}));
    FrameImage result{.declaration = declaration, .image = std::move(image)};
    for (uint32_t mip = 0; mip < result.image.info.mips; ++mip) {
        DERMIS_TRY_ASSIGN(OwnedView view, make_mip_view(context, result.image, mip));
        result.mip_views.push_back(std::move(view));
        set_object_name(context, VK_OBJECT_TYPE_IMAGE_VIEW, result.mip_views.back().get(),
                        fmt::format("{} mip {}", declaration.name, mip));
        result.last_use.push_back(ImageUse::none);
    }
    return result;
}

Result<void> FrameImages::clear(FrameImage& image) {
    const Context& context = device_->context;
    return run_once(*device_, "the first clear of " + image.declaration.name, [&](VkCommandBuffer commands) {
        BarrierBatch barriers;
        barriers.add(image, 0, image.image.info.mips, ImageUse::copy_target, true);
        barriers.record(context, commands);
        const VkImageSubresourceRange range = {image.image.info.aspect, 0, image.image.info.mips, 0, 1};
        const VkClearColorValue zero = {};
        const VkClearDepthStencilValue far = {.depth = 1};
        constexpr VkImageLayout kLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        if (is_depth(image.declaration.format))
            context.vk.vkCmdClearDepthStencilImage(commands, image.image.handle.get(), kLayout, &far, 1,
                                                   &range);
        else
            context.vk.vkCmdClearColorImage(commands, image.image.handle.get(), kLayout, &zero, 1, &range);
    });
}

// The barrier between two uses of an image: one rule for all passes.

namespace {

// All shader stages at once: a later read in another stage then needs no barrier of its own.
constexpr VkPipelineStageFlags2 kShaders = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                           VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepthTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

}  // namespace

UseScope use_scope(ImageUse use) {
    switch (use) {
        case ImageUse::none:
            return {};
        case ImageUse::sampled:
            return {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kShaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                    false};
        case ImageUse::depth_test:
            return {VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL, kShaders | kDepthTests,
                    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                    false};
        case ImageUse::storage:
            return {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, true};
        case ImageUse::color_target:
            return {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, true};
        // A resolve of depth happens in the colour output stage, with colour access.
        case ImageUse::depth_target:
            return {VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                    kDepthTests | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                        VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                    true};
        case ImageUse::copy_source:
            return {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_TRANSFER_READ_BIT, false};
        case ImageUse::copy_target:
            return {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_TRANSFER_WRITE_BIT, true};
    }
    return {};
}

void BarrierBatch::add(FrameImage& image, uint32_t first_mip, uint32_t mips, ImageUse use, bool discard) {
    for (uint32_t mip = first_mip; mip < first_mip + mips; ++mip) {
        const UseScope before = use_scope(image.last_use[mip]), after = use_scope(use);
        const bool same = image.last_use[mip] == use;
        image.last_use[mip] = use;
        if (same && !after.writes) continue;
        barriers_.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                             .srcStageMask = before.stages,
                             .srcAccessMask = before.writes ? before.access : VkAccessFlags2{0},
                             .dstStageMask = after.stages,
                             .dstAccessMask = after.access,
                             .oldLayout = discard ? VK_IMAGE_LAYOUT_UNDEFINED : before.layout,
                             .newLayout = after.layout,
                             .image = image.image.handle.get(),
                             .subresourceRange = {image.image.info.aspect, mip, 1, 0, 1}});
    }
}

void BarrierBatch::record(const Context& context, VkCommandBuffer commands) {
    if (barriers_.empty()) return;
    const VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                         .imageMemoryBarrierCount = uint32_t(barriers_.size()),
                                         .pImageMemoryBarriers = barriers_.data()};
    context.vk.vkCmdPipelineBarrier2(commands, &dependency);
    barriers_.clear();
}

// A level of a frame image into memory.

Result<Image> read_image(Device::State& device, FrameImage& source, int mip) {
    const Context& context = device.context;
    const ImageDeclaration& declaration = source.declaration;
    if (declaration.samples > 1)
        return Error{"image '" + declaration.name + "' is multisampled; resolve it first"};
    if (mip < 0 || uint32_t(mip) >= source.image.info.mips)
        return Error{fmt::format("image '{}' has no mip level {}", declaration.name, mip)};
    const VkExtent2D extent = source.extent(mip);
    const FormatInfo format = format_info(declaration.format);
    const size_t size = size_t(extent.width) * extent.height * bytes_per_texel(declaration.format);
    DERMIS_TRY_ASSIGN(const Buffer staging,
                      make_buffer(context, "read-back of " + declaration.name, size,
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback));
    DERMIS_TRY(run_once(device, "the read-back of " + declaration.name, [&](VkCommandBuffer commands) {
        BarrierBatch barriers;
        barriers.add(source, uint32_t(mip), 1, ImageUse::copy_source, false);
        barriers.record(context, commands);
        const VkBufferImageCopy region = {.imageSubresource = {format.aspect, uint32_t(mip), 0, 1},
                                          .imageExtent = {extent.width, extent.height, 1}};
        context.vk.vkCmdCopyImageToBuffer(commands, source.image.handle.get(),
                                          VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.handle.get(), 1,
                                          &region);
        const VkMemoryBarrier2 to_host = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                          .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                          .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                          .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                          .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
        const VkDependencyInfo dependency = {
            .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &to_host};
        context.vk.vkCmdPipelineBarrier2(commands, &dependency);
    }));
    Image image;
    image.width = int(extent.width);
    image.height = int(extent.height);
    image.channels = format.channels;
    image.format = format.pixel;
    image.bytes.assign(staging.mapped, staging.mapped + size);
    return image;
}

}  // namespace dermis::gpu
