#pragma once
// A plan into a command buffer: labels, barriers, passes, queries.

#include "dermis/gpu/plan.h"

namespace dermis::gpu {

/// Timestamps around every pass, and the number of samples that passed the depth test.
class FrameQueries {
  public:
    /// Makes room for the plan's passes and notes their names and sizes.
    [[nodiscard]] Result<void> prepare(const Context& context, const Plan& plan);
    void reset(const Context& context, VkCommandBuffer commands) const;
    /// Timestamp number `index`: 0 before the first pass, i + 1 after pass i.
    void timestamp(const Context& context, VkCommandBuffer commands, size_t index) const;
    void begin_samples(const Context& context, VkCommandBuffer commands, size_t pass) const;
    void end_samples(const Context& context, VkCommandBuffer commands, size_t pass) const;

    /// After the frame is done. Times are 0 on a queue without timestamps.
    [[nodiscard]] Result<FrameResult> collect(const Context& context) const;

  private:
    OwnedQueryPool timestamps_, samples_;
    size_t capacity_ = 0;
    std::vector<PassTiming> passes_;  ///< without times
    std::vector<bool> counted_;       ///< which of them count samples
};

/// `uploads` holds the plan's bytes.
void record_plan(const Context& context, VkCommandBuffer commands, const Plan& plan, VkBuffer uploads,
                 const FrameQueries& queries);

}  // namespace dermis::gpu
