#pragma once
// UVs for triangles that have none, or whose UVs fold over themselves.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// Charts in millimetres, each with an origin of its own: they must be packed.
struct Unwrapping {
    std::vector<std::array<Vec2, 3>> corners_mm;  ///< of each given triangle; v points down
    std::vector<uint32_t> chart;                  ///< of each given triangle
    uint32_t charts = 0;
};

/// Charts grow over the surface while its normals stay within `cone_rad` of their mean, and are projected
/// along that mean. So a chart does not fold, and its texels are stretched by at most 1 / cos(cone_rad); a
/// chart can still cover itself where the surface winds. Linear but for a sort; 50 ms for 20,000 triangles.
[[nodiscard]] Unwrapping unwrap(const Mesh& mesh, std::span<const uint32_t> triangles,
                                float cone_rad = 0.96f);

}  // namespace dermis::inline mesh
