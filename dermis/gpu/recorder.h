#pragma once
// A plan into a command buffer: labels, barriers, passes, queries.

#include "dermis/gpu/queries.h"

namespace dermis::gpu {

/// `uploads` holds the plan's bytes.
void record_plan(const Context& context, VkCommandBuffer commands, const Plan& plan, VkBuffer uploads,
                 const FrameQueries& queries);

/// resolve, generate_mips and copy; barriers of planned.accesses have been recorded.
void record_transfer(const Context& context, VkCommandBuffer commands, const PlannedPass& planned);

}  // namespace dermis::gpu
