#pragma once
// A model of what a frame costs on a card nobody needs to own: the compiler's statistics of every shader, how
// often it runs, and the bytes that move. It estimates the time of each of two resources and takes the
// larger; docs/performance.md has its assumptions.

#include <string>
#include <vector>

#include "dermis/gpu/statistics.h"
#include "dermis/report/card.h"
#include "dermis/report/work.h"

namespace dermis::inline report {

struct ShaderCost {
    gpu::ShaderStatistics statistics;
    uint64_t invocations = 0;
    double arithmetic_ms = 0;
};

struct PassCost {
    std::string pass;
    std::vector<ShaderCost> shaders;
    uint64_t bytes = 0;  ///< to and from memory
    double arithmetic_ms = 0, bandwidth_ms = 0;
    /// The larger bound.
    [[nodiscard]] double model_ms() const {
        return arithmetic_ms > bandwidth_ms ? arithmetic_ms : bandwidth_ms;
    }
};

struct FrameCost {
    std::vector<PassCost> passes;
    [[nodiscard]] double model_ms() const;
};

/// `statistics`: of work.list, one a pass.
[[nodiscard]] FrameCost model_frame(const FrameWork& work, const std::vector<gpu::PassStatistics>& statistics,
                                    const Card& card);

/// Compiles every frame's passes for the card's chip. Errors: as gpu::NullDevice::open(); a shader that does
/// not compile.
[[nodiscard]] Result<std::vector<FrameCost>> model_frames(const std::vector<FrameWork>& frames,
                                                          const Card& card, const gpu::ShaderSource& shaders);

/// Bytes that a pass moves: attachments as fragments touch them, images of the list once each, textures a
/// texel for each fragment and at most once each, vertices and indices once each.
[[nodiscard]] uint64_t bytes_moved(const FrameWork& work, size_t pass, const gpu::PassStatistics& statistics);

}  // namespace dermis::inline report
