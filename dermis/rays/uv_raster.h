#pragma once
// Which point of which triangle lies under each texel of a map.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "dermis/image/image.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

inline constexpr uint32_t kNoTriangle = ~0u;

/// A texel's centre; u and v are the weights of the second and third corner.
struct UvTexel {
    uint32_t object = 0, triangle = kNoTriangle;
    float u = 0, v = 0;

    [[nodiscard]] bool covered() const { return triangle != kNoTriangle; }
    /// For RayScene::surface_at; n_face is left to the caller.
    [[nodiscard]] RayHit as_hit(Vec3 n_face) const { return {0, object, triangle, u, v, n_face}; }
};

struct UvRaster {
    int width = 0, height = 0;
    std::vector<UvTexel> texels;  ///< width * height, rows from the top (v = 0)
    size_t covered = 0;
    size_t overlapping = 0;  ///< texels that more than one triangle covers; the last drawn is kept
    size_t outside = 0;      ///< triangles with a corner outside 0..1: not drawn
};

/// Which materials to draw, by their number in the object's mesh.
using MaterialFilter = std::function<bool(const SceneObject& object, uint32_t material)>;
[[nodiscard]] bool is_skin(const SceneObject& object, uint32_t material);

/// The triangles of the materials that pass. Centres on a shared edge belong to one side only (top-left
/// rule). Triangles without UVs or without area in UV are not drawn. 2048 x 2048 of 17,684 triangles takes
/// about 40 ms on one core.
[[nodiscard]] UvRaster rasterise_uv(std::span<const SceneObject> objects, int width, int height,
                                    const MaterialFilter& wanted = is_skin, UvSet set = UvSet::file);

/// One channel, u8: 255 where a triangle covers the texel.
[[nodiscard]] Image coverage_mask(const UvRaster& raster);

[[nodiscard]] std::array<Vec3, 3> corners_mm(const Mesh& mesh, uint32_t triangle);
[[nodiscard]] float triangle_area_mm2(const Mesh& mesh, uint32_t triangle);
/// Geometric normal by winding; zero for a degenerate triangle.
[[nodiscard]] Vec3 face_normal(const Mesh& mesh, uint32_t triangle);

}  // namespace dermis::inline rays
