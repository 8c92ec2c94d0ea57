#pragma once
// Attributes of the skin in a pixel's centre that decide its region. Internal to
// dermis/judge.

#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/scene/scene.h"

namespace dermis::inline judge {

struct RegionPoint {
    bool skin = false;
    Vec3 p_mm;
    float n_dot_l = 0;         ///< shading normal, key light
    bool faces_light = false;  ///< by the interpolated normal, so that its shadow is a cast one
    bool lit = false;          ///< nothing between it and the key light
    float thickness_mm = 0;    ///< to the next skin behind it; large where there is none
    float curvature_per_mm = 0;
};

/// One a pixel of the mask; `skin` is false where the mask is 0. Errors: maps, the ray library.
[[nodiscard]] Result<std::vector<RegionPoint>> find_region_points(const Scene& scene, const Image& mask);

/// 1 where a point is nearer than `near_mm` to one of `others_mm`.
[[nodiscard]] Image near_points(const std::vector<RegionPoint>& points, const std::vector<Vec3>& others_mm,
                                float near_mm, int width, int height);

/// Middles between neighbouring pixels of which one is lit and the other in a cast shadow.
[[nodiscard]] std::vector<Vec3> shadow_edges_mm(const std::vector<RegionPoint>& points, int width, int height,
                                                float near_mm);

/// Middles of the triangles that the outside does not see.
[[nodiscard]] Result<std::vector<Vec3>> hidden_skin_mm(const Scene& scene);

}  // namespace dermis::inline judge
