// Passes without shaders: resolve, copy, and the mip chain by successive halving.

#include "dermis/gpu/recorder.h"

namespace dermis::gpu {
namespace {

// A render pass without draws: it resolves depth, which vkCmdResolveImage cannot.
void resolve(const Context& context, VkCommandBuffer commands, const PlannedPass& planned) {
    const ImageAccess &source = planned.accesses[0], &target = planned.accesses[1];
    const bool depth = is_depth(source.image->declaration.format);
    const VkImageLayout layout = use_scope(source.use).layout;
    const VkRenderingAttachmentInfo attachment = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = source.image->mip_views[0].get(),
        .imageLayout = layout,
        .resolveMode = depth ? VK_RESOLVE_MODE_SAMPLE_ZERO_BIT : VK_RESOLVE_MODE_AVERAGE_BIT,
        .resolveImageView = target.image->mip_views[target.first_mip].get(),
        .resolveImageLayout = layout,
        .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {.extent = planned.extent},
                                  .layerCount = 1,
                                  .colorAttachmentCount = depth ? 0u : 1u,
                                  .pColorAttachments = depth ? nullptr : &attachment,
                                  .pDepthAttachment = depth ? &attachment : nullptr};
    context.vk.vkCmdBeginRendering(commands, &info);
    context.vk.vkCmdEndRendering(commands);
}

// Leaves every level but the last as a copy source, and records that in the tracked uses.
void generate_mips(const Context& context, VkCommandBuffer commands, const PlannedPass& planned) {
    FrameImage& image = *planned.accesses[0].image;
    BarrierBatch barriers;
    for (uint32_t mip = 1; mip < image.image.info.mips; ++mip) {
        barriers.add(image, mip - 1, 1, ImageUse::copy_source, false);
        barriers.add(image, mip, 1, ImageUse::copy_target, true);
        barriers.record(context, commands);
        blit_mip(context, commands, image.image, mip);
    }
}

void copy(const Context& context, VkCommandBuffer commands, const PlannedPass& planned) {
    const ImageAccess &source = planned.accesses[0], &target = planned.accesses[1];
    const ImageInfo &from = source.image->image.info, &to = target.image->image.info;
    const VkImageSubresourceLayers from_level = {from.aspect, 0, 0, 1};
    const VkImageSubresourceLayers to_level = {to.aspect, target.first_mip, 0, 1};
    const VkExtent2D size = planned.extent;
    const VkImage source_image = source.image->image.handle.get();
    const VkImage target_image = target.image->image.handle.get();
    if (from.format == to.format && from.extent.width == size.width && from.extent.height == size.height) {
        const VkImageCopy region = {
            .srcSubresource = from_level, .dstSubresource = to_level, .extent = {size.width, size.height, 1}};
        context.vk.vkCmdCopyImage(commands, source_image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target_image,
                                  VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        return;
    }
    const VkImageBlit region = {
        .srcSubresource = from_level,
        .srcOffsets = {{}, {int32_t(from.extent.width), int32_t(from.extent.height), 1}},
        .dstSubresource = to_level,
        .dstOffsets = {{}, {int32_t(size.width), int32_t(size.height), 1}}};
    context.vk.vkCmdBlitImage(commands, source_image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target_image,
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_LINEAR);
}

}  // namespace

void record_transfer(const Context& context, VkCommandBuffer commands, const PlannedPass& planned) {
    if (planned.pass->kind == PassKind::resolve) return resolve(context, commands, planned);
    if (planned.pass->kind == PassKind::copy) return copy(context, commands, planned);
    generate_mips(context, commands, planned);
}

}  // namespace dermis::gpu
