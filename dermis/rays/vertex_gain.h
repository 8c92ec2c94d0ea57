#pragma once
// The gain of each place of a scene's skin by random walks: how much of uniform light the place returns, over
// flat skin of the same medium (docs/transport.md). One value a vertex, as the gain is smooth.

#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/gain_form.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

struct VertexGainSettings {
    float walks_per_mm2 = 32;   ///< 0.1..10000
    int least_walks = 1 << 18;  ///< in all, for small objects
};

struct VertexGains {
    /// One array an object, one value a vertex: 1 on what is not skin.
    std::vector<std::vector<Vec3>> gains;
    Vec3 noise;  ///< standard error of the gain, root mean square over the skin; up to a third too low
};

/// Walks start all over the visible skin, with diffuse light, and end at the boundary of the flesh
/// (FleshBoundary). One that ends in hidden skin, where less than 0.3 of a uniform sky arrives, counts less:
/// it is dark behind lids and in nostrils. A walk in flat skin with the same random numbers is the control
/// variate. The gain less gain(form, curvature) is fitted by fit_without_noise(), so the part of the gain
/// that curvature explains stays sharp. Deterministic; cached by content. Cost: about 0.5 microseconds a
/// walk. Errors: settings out of range, the ray library fails.
[[nodiscard]] Result<VertexGains> walk_vertex_gains(std::span<const SceneObject> objects,
                                                    const ScatteringMedium& medium,
                                                    const VertexGainSettings& settings = {});

}  // namespace dermis::inline rays
