// The barrier between two uses of an image: one rule for all passes.

#include "dermis/gpu/frame_images.h"

namespace dermis::gpu {
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

}  // namespace dermis::gpu
