#pragma once
// Timestamps around every pass, and samples that passed the depth test.

#include "dermis/gpu/plan.h"

namespace dermis::gpu {

class FrameQueries {
  public:
    /// Room for the plan's passes, and what is to be told of them.
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

}  // namespace dermis::gpu
