#pragma once
// How far light goes through flesh between two points of the skin. Straight, as a diffusion profile has it,
// where the segment between them lies in flesh. Across a fold, between lips or the walls of a crease, it goes
// around the bottom of the gap: light that crosses the air has left the skin, and what of it falls on skin
// again is light between surfaces, which no technique here computes. Random walks go around too: on the dark
// wall of a groove of 20 degrees, the straight distance gave 50 to 300 times their light, this way 20 times
// at most, where there is hardly any (tests/reference/across_gap_test.cpp).

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
