#pragma once
// Length of the way through flesh between two points of the skin: straight where the segment lies in flesh,
// around the bottom of the gap across a fold (between lips or the walls of a crease). Light that crosses the
// air has left the skin; light between surfaces is not computed. Random walks go around too
// (tests/reference/across_gap_test.cpp).

#include "dermis/rays/ray_scene.h"

namespace dermis::inline reference {

struct SkinPoint {
    Vec3 p_mm, n_face;
};

/// Length in mm, at least |from - to|. The bottom of a gap is found by a ray from its middle against the mean
/// of the normals on both sides; where that meets a wall, it goes on from there, six times at most.
/// Infinite where a gap has no bottom within `longest_mm`, as between two bodies. Cost: a ray, and one to
/// seven for each gap.
[[nodiscard]] float way_through_flesh_mm(const RayScene& rays, const SkinPoint& from, const SkinPoint& to,
                                         float longest_mm);

}  // namespace dermis::inline reference
