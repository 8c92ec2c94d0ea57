#include "dermis/judge/region_points.h"

#include <cmath>
#include <unordered_map>

#include "dermis/base/parallel.h"
#include "dermis/rays/camera_ray.h"
#include "dermis/rays/flesh.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/materials.h"

namespace dermis::inline judge {
namespace {

// Cosine from which a surface faces the light; lower ones may lie behind their own facet.
constexpr float kFacesLight = 0.1f;

float curvature_at(const Mesh& mesh, const RayHit& hit) {
    if (mesh.curvatures_per_mm.empty()) return 0;
    const auto corner = [&](size_t k) {
        return mean_curvature(mesh.curvatures_per_mm[mesh.indices[3 * size_t(hit.triangle) + k]]);
    };
    return corner(0) * (1 - hit.u - hit.v) + corner(1) * hit.u + corner(2) * hit.v;
}

// Everything that a pixel's point is found with.
struct Finder {
    const Scene& scene;
    const RayScene& rays;
    const MaterialSet& materials;
    Mat4 inverse_view_projection;
    int width, height;

    [[nodiscard]] float thickness_mm(const SurfaceAttributes& surface) const {
        const auto behind = rays.closest_hit(RaySet::skin, {.origin_mm = surface.p_world_mm,
                                                            .direction = -surface.n_geometry_world,
                                                            .min_mm = 10 * rays.epsilon_mm()});
        return behind ? behind->distance_mm : 1e30f;
    }

    [[nodiscard]] RegionPoint point(int x, int y) const {
        const auto hit = rays.closest_hit(RaySet::opaque, camera_ray(inverse_view_projection, float(x) + 0.5f,
                                                                     float(y) + 0.5f, width, height));
        if (!hit) return {};
        const SurfaceAttributes surface = rays.surface_at(*hit);
        const ShadingPoint shading = materials.shade(surface, *hit);
        const LightArrival light = light_at(scene.key_light(), surface.p_world_mm);
        const float offset_mm = 10 * rays.epsilon_mm();
        RegionPoint point{.skin = shading.material_class == MaterialClass::skin,
                          .p_mm = surface.p_world_mm,
                          .n_dot_l = dot(shading.n, light.to_light),
                          .faces_light = dot(shading.n_geometry, light.to_light) > kFacesLight,
                          .thickness_mm = thickness_mm(surface),
                          .curvature_per_mm = curvature_at(scene.objects[hit->object].mesh, *hit)};
        point.lit =
            point.faces_light &&
            !rays.occluded(RaySet::opaque, {.origin_mm = shading.p_smooth_mm + shading.n_geometry * offset_mm,
                                            .direction = light.to_light,
                                            .min_mm = offset_mm,
                                            .max_mm = light.distance_mm});
        return point;
    }
};

// Points in cubes of the search distance: what is near lies in a cube or the 26 around it.
class PointGrid {
  public:
    PointGrid(const std::vector<Vec3>& points_mm, float near_mm) : points_mm_(points_mm), near_mm_(near_mm) {
        for (size_t i = 0; i < points_mm.size(); ++i)
            cells_[key(cell(points_mm[i].x), cell(points_mm[i].y), cell(points_mm[i].z))].push_back(i);
    }
    [[nodiscard]] bool any_near(Vec3 p_mm) const {
        const int x = cell(p_mm.x), y = cell(p_mm.y), z = cell(p_mm.z);
        for (int i = 0; i < 27; ++i) {
            const auto found = cells_.find(key(x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1));
            if (found == cells_.end()) continue;
            for (const size_t other : found->second)
                if (length(points_mm_[other] - p_mm) <= near_mm_) return true;
        }
        return false;
    }

  private:
    [[nodiscard]] int cell(float v) const { return int(std::floor(v / near_mm_)); }
    static uint64_t key(int x, int y, int z) {
        constexpr uint64_t kMask = (1u << 21) - 1;
        return (uint64_t(x) & kMask) << 42 | (uint64_t(y) & kMask) << 21 | (uint64_t(z) & kMask);
    }
    const std::vector<Vec3>& points_mm_;
    float near_mm_;
    std::unordered_map<uint64_t, std::vector<size_t>> cells_;
};

}  // namespace

Result<std::vector<RegionPoint>> find_region_points(const Scene& scene, const Image& mask) {
    DERMIS_TRY_ASSIGN(const RayScene rays, RayScene::build(scene.objects));
    DERMIS_TRY_ASSIGN(const MaterialSet materials, MaterialSet::load(scene));
    const float aspect = float(mask.width) / float(mask.height);
    const Finder finder{scene,      rays,
                        materials,  camera_matrices(scene.camera, aspect).inverse_view_projection,
                        mask.width, mask.height};
    std::vector<RegionPoint> points(mask.pixel_count());
    parallel_for(size_t(mask.height), 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < size_t(mask.width); ++x)
                if (const size_t i = y * size_t(mask.width) + x; mask.floats()[i] > 0)
                    points[i] = finder.point(int(x), int(y));
    });
    return points;
}

Image near_points(const std::vector<RegionPoint>& points, const std::vector<Vec3>& others_mm, float near_mm,
                  int width, int height) {
    Image near(width, height, 1);
    const PointGrid grid(others_mm, near_mm);
    for (size_t i = 0; i < points.size(); ++i)
        near.floats()[i] = points[i].skin && grid.any_near(points[i].p_mm) ? 1 : 0;
    return near;
}

std::vector<Vec3> shadow_edges_mm(const std::vector<RegionPoint>& points, int width, int height,
                                  float near_mm) {
    std::vector<Vec3> edges_mm;
    const auto compare = [&](const RegionPoint& a, const RegionPoint& b) {
        const bool both = a.skin && b.skin && a.faces_light && b.faces_light;
        if (both && a.lit != b.lit && length(a.p_mm - b.p_mm) <= near_mm)
            edges_mm.push_back((a.p_mm + b.p_mm) * 0.5f);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t i = size_t(y) * size_t(width) + size_t(x);
            if (x + 1 < width) compare(points[i], points[i + 1]);
            if (y + 1 < height) compare(points[i], points[i + size_t(width)]);
        }
    return edges_mm;
}

Result<std::vector<Vec3>> hidden_skin_mm(const Scene& scene) {
    DERMIS_TRY_ASSIGN(const std::vector<Flesh> flesh, find_flesh(scene.objects));
    std::vector<Vec3> hidden_mm;
    for (size_t object = 0; object < flesh.size(); ++object) {
        const Mesh& mesh = scene.objects[object].mesh;
        for (size_t triangle = 0; triangle < flesh[object].faces.size(); ++triangle) {
            if (flesh[object].faces[triangle] == SkinFace::visible) continue;
            const uint32_t* corner = &mesh.indices[3 * triangle];
            hidden_mm.push_back(
                (mesh.positions_mm[corner[0]] + mesh.positions_mm[corner[1]] + mesh.positions_mm[corner[2]]) *
                (1 / 3.0f));
        }
    }
    return hidden_mm;
}

}  // namespace dermis::inline judge
