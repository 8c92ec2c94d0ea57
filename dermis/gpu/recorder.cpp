#include "dermis/gpu/recorder.h"

#include <algorithm>

#include "dermis/gpu/frame_descriptors.h"

namespace dermis::gpu {
namespace {

VkAttachmentLoadOp load_op(LoadOp load) {
    constexpr VkAttachmentLoadOp kOps[] = {VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_LOAD,
                                           VK_ATTACHMENT_LOAD_OP_DONT_CARE};
    return kOps[size_t(load)];
}

// Records one pass after another, with the upload buffer and the queries.
class Recorder {
  public:
    Recorder(const Context& context, VkCommandBuffer commands, VkBuffer uploads, const FrameQueries& queries)
        : context_(context), vk_(context.vk), commands_(commands), uploads_(uploads), queries_(queries) {}

    void record(const PlannedPass& planned, size_t index) {
        begin_label(planned.pass->name);
        for (const ImageAccess& access : planned.accesses)
            barriers_.add(*access.image, access.first_mip, access.mips, access.use, access.discard);
        barriers_.record(context_, commands_);
        if (is_transfer(planned.pass->kind))
            record_transfer(context_, commands_, planned);
        else if (planned.pass->kind == PassKind::compute)
            dispatch(planned);
        else
            raster(planned, index);
        if (context_.end_label) context_.end_label(commands_);
    }

  private:
    void begin_label(const std::string& name) {
        if (!context_.begin_label) return;
        const VkDebugUtilsLabelEXT label = {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                            .pLabelName = name.c_str()};
        context_.begin_label(commands_, &label);
    }

    // Accesses begin with the targets, in the order of pass.colors, then depth (plan.cpp).
    void begin_rendering(const PlannedPass& planned) {
        const Pass& pass = *planned.pass;
        std::vector<VkRenderingAttachmentInfo> colors;
        for (const ColorTarget& target : pass.colors) {
            const FrameImage& image = *planned.accesses[colors.size()].image;
            VkRenderingAttachmentInfo& info = colors.emplace_back();
            info = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                    .imageView = image.mip_views[size_t(target.mip)].get(),
                    .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                    .loadOp = load_op(target.load),
                    .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
            std::ranges::copy(target.clear, info.clearValue.color.float32);
        }
        VkRenderingAttachmentInfo depth = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        if (pass.depth) {
            depth.imageView = planned.accesses[colors.size()].image->mip_views[0].get();
            depth.imageLayout = use_scope(planned.accesses[colors.size()].use).layout;
            depth.loadOp = load_op(pass.depth->load);
            depth.storeOp =
                only_tests(*pass.depth) ? VK_ATTACHMENT_STORE_OP_NONE : VK_ATTACHMENT_STORE_OP_STORE;
            depth.clearValue.depthStencil.depth = pass.depth->clear;
        }
        const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                      .renderArea = {.extent = planned.extent},
                                      .layerCount = 1,
                                      .colorAttachmentCount = uint32_t(colors.size()),
                                      .pColorAttachments = colors.data(),
                                      .pDepthAttachment = pass.depth ? &depth : nullptr};
        vk_.vkCmdBeginRendering(commands_, &info);
    }

    void raster(const PlannedPass& planned, size_t index) {
        begin_rendering(planned);
        if (planned.pipeline) {
            const VkViewport viewport = {0, 0, float(planned.extent.width), float(planned.extent.height),
                                         0, 1};
            const Pass& pass = *planned.pass;
            vk_.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, planned.pipeline->handle.get());
            vk_.vkCmdSetViewport(commands_, 0, 1, &viewport);
            set_scissor(planned.extent, {});
            if (pass.depth_bias_constant != 0 || pass.depth_bias_slope != 0)
                vk_.vkCmdSetDepthBias(commands_, pass.depth_bias_constant, 0, pass.depth_bias_slope);
            push_constants(planned);
            queries_.begin_samples(context_, commands_, index);
            for (const PlannedDraw& draw : planned.draws) {
                if (draw.scissor) set_scissor(planned.extent, draw.scissor);
                this->draw(*planned.pipeline, draw);
                if (draw.scissor) set_scissor(planned.extent, {});
            }
            queries_.end_samples(context_, commands_, index);
        }
        vk_.vkCmdEndRendering(commands_);
    }

    // The part of the rectangle that lies on the targets.
    void set_scissor(VkExtent2D extent, const std::optional<PixelRect>& rect) {
        VkRect2D scissor = {{}, extent};
        if (rect) {
            const int right = std::clamp(rect->x + rect->width, 0, int(extent.width));
            const int bottom = std::clamp(rect->y + rect->height, 0, int(extent.height));
            scissor.offset = {std::clamp(rect->x, 0, right), std::clamp(rect->y, 0, bottom)};
            scissor.extent = {uint32_t(right - scissor.offset.x), uint32_t(bottom - scissor.offset.y)};
        }
        vk_.vkCmdSetScissor(commands_, 0, 1, &scissor);
    }

    void dispatch(const PlannedPass& planned) {
        const auto& local = planned.pipeline->local_size;
        vk_.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, planned.pipeline->handle.get());
        push_constants(planned);
        bind_descriptors(*planned.pipeline, planned.draws.front());
        vk_.vkCmdDispatch(commands_, (planned.extent.width + local[0] - 1) / local[0],
                          (planned.extent.height + local[1] - 1) / local[1], 1);
    }

    void draw(const Pipeline& pipeline, const PlannedDraw& draw) {
        bind_descriptors(pipeline, draw);
        if (draw.index_count == 0) return vk_.vkCmdDraw(commands_, 3, 1, 0, 0);
        std::vector<VkBuffer> buffers;
        std::vector<VkDeviceSize> offsets;
        for (const BufferPlace& place : draw.vertices) {
            buffers.push_back(place.buffer ? place.buffer : uploads_);
            offsets.push_back(place.offset);
        }
        if (!buffers.empty())
            vk_.vkCmdBindVertexBuffers(commands_, 0, uint32_t(buffers.size()), buffers.data(),
                                       offsets.data());
        vk_.vkCmdBindIndexBuffer(commands_, draw.indices.buffer ? draw.indices.buffer : uploads_,
                                 draw.indices.offset, VK_INDEX_TYPE_UINT32);
        vk_.vkCmdDrawIndexed(commands_, draw.index_count, 1, draw.first_index, 0, 0);
    }

    void push_constants(const PlannedPass& planned) {
        if (planned.push_constants.empty()) return;
        vk_.vkCmdPushConstants(commands_, planned.pipeline->layout.get(), planned.pipeline->push_stages, 0,
                               uint32_t(planned.push_constants.size()), planned.push_constants.data());
    }

    void bind_descriptors(const Pipeline& pipeline, const PlannedDraw& draw) {
        if (draw.descriptors.empty()) return;
        if (draw.set)
            return vk_.vkCmdBindDescriptorSets(commands_, pipeline.bind_point, pipeline.layout.get(), 0, 1,
                                               &draw.set, 0, nullptr);
        const DescriptorWrites writes(draw, uploads_);
        vk_.vkCmdPushDescriptorSetKHR(commands_, pipeline.bind_point, pipeline.layout.get(), 0,
                                      uint32_t(writes.all().size()), writes.all().data());
    }

    const Context& context_;
    const VolkDeviceTable& vk_;
    VkCommandBuffer commands_;
    VkBuffer uploads_;
    const FrameQueries& queries_;
    BarrierBatch barriers_;
};

}  // namespace

void record_plan(const Context& context, VkCommandBuffer commands, const Plan& plan, VkBuffer uploads,
                 const FrameQueries& queries) {
    queries.reset(context, commands);
    queries.timestamp(context, commands, 0);
    Recorder recorder(context, commands, uploads, queries);
    for (size_t i = 0; i < plan.passes.size(); ++i) {
        recorder.record(plan.passes[i], i);
        queries.timestamp(context, commands, i + 1);
    }
}

}  // namespace dermis::gpu
