#pragma once
// The cost of a technique: bytes of its tables and images, frame times.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/render/renderer.h"
#include "dermis/technique/technique_list.h"

namespace dermis::inline judge {

struct TechniqueCost {
    double time_ms = 0;      ///< median of whole frames
    double time_ratio = 0;   ///< median over frames of time / the baseline's in the same round; 0 without it
    size_t table_bytes = 0;  ///< tables baked for it
    size_t image_bytes = 0;  ///< images that only its own passes use
    [[nodiscard]] size_t bytes() const { return table_bytes + image_bytes; }
};

/// One entry a contestant, at this size. `frames` timed ones after one that compiles; 0: none are. Rounds go
/// over all contestants, so that a machine that is busy for a while is so for all of them. Errors name the
/// contestant. `progress`: called before each frame with the share of them that is done. `stop` ends it after
/// a round: times are of the rounds so far.
[[nodiscard]] Result<std::vector<TechniqueCost>> measure_costs(
    Renderer& renderer, const Scene& scene, const std::vector<Contestant>& contestants, int width, int height,
    int frames, const std::function<void(double done, const std::string& name)>& progress = {},
    const std::atomic<bool>* stop = nullptr);

}  // namespace dermis::inline judge
