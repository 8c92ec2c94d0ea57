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

// Passes without shaders: resolve, copy, and the mip chain by successive halving. resolve() is a render pass
// without draws, because vkCmdResolveImage cannot resolve depth.
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

// The barriers of planned.accesses have been recorded.
void record_transfer(const Context& context, VkCommandBuffer commands, const PlannedPass& planned) {
    if (planned.pass->kind == PassKind::resolve) return resolve(context, commands, planned);
    if (planned.pass->kind == PassKind::copy) return copy(context, commands, planned);
    generate_mips(context, commands, planned);
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

    // Between a pass that writes buffers and all that reads or writes them before and after, also in frames
    // of other executors: there are few such passes.
    void order_buffers() {
        constexpr VkPipelineStageFlags2 kStages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                                  VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT |
                                                  VK_PIPELINE_STAGE_2_COPY_BIT;
        const VkMemoryBarrier2 barrier = {
            .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
            .srcStageMask = kStages,
            .srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
            .dstStageMask = kStages,
            .dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                             VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT};
        const VkDependencyInfo info = {
            .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
        vk_.vkCmdPipelineBarrier2(commands_, &info);
    }

    void dispatch(const PlannedPass& planned) {
        const auto& local = planned.pipeline->local_size;
        vk_.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, planned.pipeline->handle.get());
        push_constants(planned);
        bind_descriptors(*planned.pipeline, planned.draws.front());
        const bool writes_buffers = !planned.pass->buffers.empty();
        if (writes_buffers) order_buffers();
        vk_.vkCmdDispatch(commands_, (planned.extent.width + local[0] - 1) / local[0],
                          (planned.extent.height + local[1] - 1) / local[1], 1);
        if (writes_buffers) order_buffers();
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

namespace {

Result<OwnedQueryPool> make_pool(const Context& context, VkQueryType type, size_t count) {
    const VkQueryPoolCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = type, .queryCount = uint32_t(count)};
    return make<OwnedQueryPool>(context, context.vk.vkCreateQueryPool, info, "make a query pool");
}

Result<std::vector<uint64_t>> read_pool(const Context& context, VkQueryPool pool, size_t first,
                                        size_t count) {
    std::vector<uint64_t> values(count);
    const VkResult result = context.vk.vkGetQueryPoolResults(
        context.device, pool, uint32_t(first), uint32_t(count), count * sizeof(uint64_t), values.data(),
        sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    DERMIS_TRY(check(result, "read the timings"));
    return values;
}

// Only some of the bits are valid, and they may wrap around.
double elapsed_ms(const Context& context, uint64_t from, uint64_t to) {
    const uint64_t mask =
        context.timestamp_bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << context.timestamp_bits) - 1;
    return double((to - from) & mask) * context.properties.limits.timestampPeriod * 1e-6;
}

// All passes that rasterise with a pipeline.
bool counts_samples(const PlannedPass& planned) {
    return planned.pipeline && planned.pipeline->bind_point == VK_PIPELINE_BIND_POINT_GRAPHICS;
}

}  // namespace

Result<void> FrameQueries::prepare(const Context& context, const Plan& plan) {
    passes_.clear();
    counted_.clear();
    for (const PlannedPass& planned : plan.passes) {
        passes_.push_back({.name = planned.pass->name,
                           .target_texels = uint64_t(planned.extent.width) * planned.extent.height});
        counted_.push_back(counts_samples(planned));
    }
    const size_t passes = passes_.size();
    if (passes <= capacity_) return {};
    DERMIS_TRY_ASSIGN(OwnedQueryPool timestamps, make_pool(context, VK_QUERY_TYPE_TIMESTAMP, passes + 1));
    DERMIS_TRY_ASSIGN(OwnedQueryPool samples, make_pool(context, VK_QUERY_TYPE_OCCLUSION, passes));
    timestamps_ = std::move(timestamps);
    samples_ = std::move(samples);
    capacity_ = passes;
    return {};
}

void FrameQueries::reset(const Context& context, VkCommandBuffer commands) const {
    if (!capacity_) return;
    context.vk.vkCmdResetQueryPool(commands, timestamps_.get(), 0, uint32_t(capacity_ + 1));
    context.vk.vkCmdResetQueryPool(commands, samples_.get(), 0, uint32_t(capacity_));
}

void FrameQueries::timestamp(const Context& context, VkCommandBuffer commands, size_t index) const {
    if (!capacity_ || !context.timestamp_bits) return;
    context.vk.vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_.get(),
                                    uint32_t(index));
}

void FrameQueries::begin_samples(const Context& context, VkCommandBuffer commands, size_t pass) const {
    const VkQueryControlFlags flags =
        context.features.occlusionQueryPrecise ? VkQueryControlFlags{VK_QUERY_CONTROL_PRECISE_BIT} : 0;
    context.vk.vkCmdBeginQuery(commands, samples_.get(), uint32_t(pass), flags);
}

void FrameQueries::end_samples(const Context& context, VkCommandBuffer commands, size_t pass) const {
    context.vk.vkCmdEndQuery(commands, samples_.get(), uint32_t(pass));
}

Result<FrameResult> FrameQueries::collect(const Context& context) const {
    FrameResult result{.passes = passes_};
    const size_t count = passes_.size();
    std::vector<uint64_t> times(count + 1);
    if (count && context.timestamp_bits) {
        DERMIS_TRY_ASSIGN(times, read_pool(context, timestamps_.get(), 0, count + 1));
    }
    for (size_t i = 0; i < count; ++i) {
        PassTiming& timing = result.passes[i];
        timing.time_ms = elapsed_ms(context, times[i], times[i + 1]);
        if (!counted_[i]) continue;
        DERMIS_TRY_ASSIGN(const std::vector<uint64_t> samples, read_pool(context, samples_.get(), i, 1));
        timing.samples_passed = samples.front();
    }
    result.frame_ms = elapsed_ms(context, times.front(), times.back());
    return result;
}

}  // namespace dermis::gpu
