#pragma once
// How a mesh's UV map stretches: millimetres on the surface for a step in UV.

#include <cstdint>
#include <vector>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// The first fundamental form of P(u, v) in mm^2 per squared UV unit: E = |dP/du|^2, F = dP/du . dP/dv,
/// G = |dP/dv|^2. All zero where the UVs have no area.
struct UvMetric {
    float e_mm2 = 0, f_mm2 = 0, g_mm2 = 0;

    [[nodiscard]] float mm_per_u() const;
    [[nodiscard]] float mm_per_v() const;
    /// Square root of the area on the surface for a unit of UV area: the length to divide by a map's size.
    [[nodiscard]] float mm_per_uv() const;
    /// Longest over shortest stretch of any direction, at least 1 (Sander et al. 2001, "Texture Mapping
    /// Progressive Meshes", the singular values Gamma and gamma). 0 where there is no metric.
    [[nodiscard]] float anisotropy() const;
};

/// Of every triangle. Needs UVs.
[[nodiscard]] std::vector<UvMetric> triangle_uv_metrics(const Mesh& mesh);

/// Of every vertex: the mean over its triangles, by their area on the surface. Across a UV seam each side
/// keeps its own. Interpolate it over the UV layout for a stretch map.
[[nodiscard]] std::vector<UvMetric> vertex_uv_metrics(const Mesh& mesh);

/// How the surface runs along u and v at a vertex: dP/du and dP/dv in mm for a step of 1 in UV, the mean over
/// its triangles by area; across a UV seam each side keeps its own. Zero where the UVs have no area.
struct UvDerivatives {
    std::vector<Vec3> du_mm, dv_mm;
};
[[nodiscard]] UvDerivatives vertex_uv_derivatives(const Mesh& mesh);

/// Area of every triangle in mm^2.
[[nodiscard]] std::vector<float> triangle_areas_mm2(const Mesh& mesh);

}  // namespace dermis::inline mesh
