#pragma once
// Measures of a UV layout for maps of skin: area used, overlaps, seams, millimetres per texel, stretch.

#include <cstdint>
#include <optional>
#include <vector>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// The first fundamental form of P(u, v) in mm^2 per squared UV unit: E = |dP/du|^2, F = dP/du . dP/dv,
/// G = |dP/dv|^2. All zero where the UVs have no area.
struct UvMetric {
    float e_mm2 = 0, f_mm2 = 0, g_mm2 = 0;

    [[nodiscard]] float mm_per_u() const;
    [[nodiscard]] float mm_per_v() const;
    /// Square root of the surface's area per unit of UV area; divide it by a map's size for mm per texel.
    [[nodiscard]] float mm_per_uv() const;
    /// Longest over shortest stretch of any direction, at least 1 (Sander et al. 2001, "Texture Mapping
    /// Progressive Meshes", the singular values Gamma and gamma). 0 for degenerate triangles.
    [[nodiscard]] float anisotropy() const;
};

/// One per triangle. Needs UVs.
[[nodiscard]] std::vector<UvMetric> triangle_uv_metrics(const Mesh& mesh);

/// One per vertex: the mean over its triangles, weighted by area on the surface; each side of a UV seam has
/// its own. Interpolate it over the UV layout for a stretch map.
[[nodiscard]] std::vector<UvMetric> vertex_uv_metrics(const Mesh& mesh);

/// dP/du and dP/dv at a vertex in mm per unit of UV, the mean over its triangles by area; each side of a UV
/// seam has its own. Zero where the UVs have no area.
struct UvDerivatives {
    std::vector<Vec3> du_mm, dv_mm;
};
[[nodiscard]] UvDerivatives vertex_uv_derivatives(const Mesh& mesh);

/// Area of every triangle in mm^2.
[[nodiscard]] std::vector<float> triangle_areas_mm2(const Mesh& mesh);

struct Percentiles {
    float p5 = 0, p50 = 0, p95 = 0;
};

struct UvReport {
    double coverage = 0;                ///< share of the used tiles' texels under a triangle, 0..1
    double overlap = 0;                 ///< share of the covered texels under more than one
    double area_outside = 0;            ///< share of the surface in no tile: u outside of 0..10, or v over 1
    std::vector<int> tiles;             ///< UDIM numbers used, ascending; an ordinary atlas is {1001}
    uint32_t charts = 0;                ///< pieces that hang together in UV
    double seam_length_mm = 0;          ///< edges where charts meet
    double area_mirrored = 0;           ///< share of the surface whose UVs are mirrored
    uint32_t degenerate_triangles = 0;  ///< no area in UV
    Percentiles mm_per_texel_2048;      ///< by surface area, of a 2048 x 2048 map
    Percentiles anisotropy;             ///< by surface area
};

/// Report of the whole mesh, or of one material (atlases are per material: two may share a tile without
/// overlap). Needs UVs. Coverage and overlap are counted at texel centres of a `resolution` grid per tile;
/// shared edges count once. Linear in triangles; the resolution is halved while the count would take seconds.
/// About 15 ms for 18,000 triangles at 1024.
[[nodiscard]] UvReport analyze_uvs(const Mesh& mesh, std::optional<uint32_t> material = std::nullopt,
                                   int resolution = 1024);

/// UDIM number of the tile a UV lies in (origin top-left, so v <= 1 is the first row); 0 for none.
[[nodiscard]] int udim_tile(Vec2 uv);

}  // namespace dermis::inline mesh
