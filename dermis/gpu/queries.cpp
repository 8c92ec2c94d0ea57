#include "dermis/gpu/queries.h"

namespace dermis::gpu {
namespace {

Result<OwnedQueryPool> make_pool(const Context& context, VkQueryType type, size_t count) {
    const VkQueryPoolCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = type, .queryCount = uint32_t(count)};
    VkQueryPool pool = VK_NULL_HANDLE;
    const VkResult result = context.vk.vkCreateQueryPool(context.device, &info, nullptr, &pool);
    DERMIS_TRY(check(result, "make a query pool"));
    return OwnedQueryPool(context, pool);
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
        DERMIS_TRY_ASSIGN(std::vector<uint64_t> read, read_pool(context, timestamps_.get(), 0, count + 1));
        times = std::move(read);
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
