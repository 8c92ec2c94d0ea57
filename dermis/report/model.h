#pragma once
// A model of what a frame costs on a card nobody needs to own: the compiler's statistics of every shader, how
// often it runs, and the bytes that move. It estimates the time of each of two resources and takes the
// larger; docs/performance.md has its assumptions.

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/gpu/statistics.h"
#include "dermis/render/renderer.h"
#include "dermis/technique/technique_list.h"

namespace dermis::inline report {

/// A graphics card that costs are modelled for: one for each chip that the compiler is asked for.
struct Card {
    std::string_view chip;  ///< as RADV_FORCE_FAMILY has it since Mesa 23
    std::string_view name;
    double clock_ghz = 0;  ///< what the maker promises in games (Vega: the boost clock)
    int compute_units = 0, simds_per_unit = 0;
    double bandwidth_gb_s = 0;  ///< of its memory, 10^9 bytes a second; caches not counted
    std::string_view source;    ///< of the figures

    /// Cycles that all SIMDs of the card have together in a millisecond.
    [[nodiscard]] double simd_cycles_per_ms() const {
        return clock_ghz * 1e6 * compute_units * simds_per_unit;
    }
    [[nodiscard]] double bytes_per_ms() const { return bandwidth_gb_s * 1e6; }
};

[[nodiscard]] std::span<const Card> cards();

/// Error: an unknown chip, with the known ones.
[[nodiscard]] Result<const Card*> find_card(std::string_view chip);

struct TextureBytes {
    uint64_t bytes = 0;
    size_t bytes_per_texel = 0;
};

/// How much a pass has to do: counted in a frame that any Vulkan device drew, for a frame of another size.
struct PassWork {
    std::string pass;
    uint64_t vertices = 0;      ///< each vertex of a draw once; 3 for a full-screen triangle
    uint64_t indices = 0;       ///< 0 for a full-screen triangle
    uint64_t fragments = 0;     ///< that passed the depth test
    uint64_t threads = 0;       ///< of a compute pass
    uint64_t buffer_bytes = 0;  ///< of all buffers that it binds, each once
    /// Bytes that the frame can bind, by name; the sum for draws with different maps.
    std::map<std::string, TextureBytes> textures;
};

struct FrameWork {
    int width = 0, height = 0;  ///< of the frame that is asked for
    PassList list;
    std::vector<PassWork> passes;  ///< one for each pass of the list
};

/// Draws two frames at a quarter of each side (the second is what follows when nothing moves, as in a
/// benchmark) and scales what it counts to width x height. Errors as Renderer::draw().
[[nodiscard]] Result<FrameWork> count_work(Renderer& renderer, const Contestant& contestant, int width,
                                           int height);

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
