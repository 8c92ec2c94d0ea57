#pragma once
// UVs for triangles that have none, or whose UVs fold over themselves.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// Charts in millimetres, each with its own origin: pack them (pack_charts.h).
struct Unwrapping {
    std::vector<std::array<Vec2, 3>> corners_mm;  ///< of each given triangle; v points down
    std::vector<uint32_t> chart;                  ///< of each given triangle
    uint32_t charts = 0;
};

/// Charts hold the surface whose normals are within 55 degrees of their mean and nearer to it than to those
/// of other charts, and are projected along that mean. What would cover texels of its own chart twice begins
/// another chart; only pieces below 2e-5 of the area may share texels with a neighbour. Texels are stretched
/// by at most 1.7, but for such pieces. Nearly linear.
[[nodiscard]] Unwrapping unwrap(const Mesh& mesh, std::span<const uint32_t> triangles);

}  // namespace dermis::inline mesh
