#pragma once
// Descriptor sets from a pool, one pool for each frame in flight. A pipeline whose descriptors cannot be
// pushed (Pipeline::pushes_descriptors) needs a set for each draw.

#include <map>

#include "dermis/gpu/plan.h"

namespace dermis::gpu {

/// The descriptors of a draw as Vulkan takes them. The draw must outlive it.
class DescriptorWrites {
  public:
    DescriptorWrites(const PlannedDraw& draw, VkBuffer uploads);
    [[nodiscard]] std::span<const VkWriteDescriptorSet> all() const { return writes_; }

  private:
    std::vector<VkDescriptorBufferInfo> buffers_;
    std::vector<VkWriteDescriptorSet> writes_;
};

class FrameDescriptors {
  public:
    /// Fills PlannedDraw::set of every draw that needs one. The frame that used the sets before must be done.
    [[nodiscard]] Result<void> prepare(const Context& context, Plan& plan, VkBuffer uploads);

  private:
    /// How many sets, and how many descriptors of each type.
    struct Room {
        uint32_t sets = 0;
        std::map<VkDescriptorType, uint32_t> descriptors;
    };

    [[nodiscard]] static Room needed_room(std::span<const PlannedDraw* const> draws);
    /// An empty pool with at least this room; grows and never shrinks.
    [[nodiscard]] Result<void> make_room(const Context& context, const Room& needed);

    OwnedDescriptorPool pool_;
    Room room_;
};

}  // namespace dermis::gpu
