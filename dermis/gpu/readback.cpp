// A level of a frame image into memory.

#include <cstring>

#include "dermis/gpu/frame_images.h"

namespace dermis::gpu {

Result<Image> read_image(Device::State& device, FrameImage& source, int mip) {
    const Context& context = device.context;
    const ImageDeclaration& declaration = source.declaration;
    if (declaration.samples > 1)
        return Error{"image '" + declaration.name + "' is multisampled; resolve it first"};
    if (mip < 0 || uint32_t(mip) >= source.image.info.mips)
        return Error{"image '" + declaration.name + "' has no mip level " + std::to_string(mip)};
    const VkExtent2D extent = source.extent(mip);
    const FormatInfo format = format_info(declaration.format);
    const size_t size = size_t(extent.width) * extent.height * bytes_per_texel(declaration.format);
    DERMIS_TRY_ASSIGN(const Buffer staging,
                      make_buffer(context, "read-back of " + declaration.name, size,
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback));
    const Result<void> done =
        run_once(device, "the read-back of " + declaration.name, [&](VkCommandBuffer commands) {
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
            const VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                                 .memoryBarrierCount = 1,
                                                 .pMemoryBarriers = &to_host};
            context.vk.vkCmdPipelineBarrier2(commands, &dependency);
        });
    if (!done) return done.error();
    Image image;
    image.width = int(extent.width);
    image.height = int(extent.height);
    image.channels = format.channels;
    image.format = format.pixel;
    image.bytes.assign(staging.mapped, staging.mapped + size);
    return image;
}

}  // namespace dermis::gpu
