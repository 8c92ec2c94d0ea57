#include "dermis/judge/cuts.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/judge/point_grid.h"
#include "dermis/rays/camera_ray.h"
#include "dermis/rays/flesh.h"
#include "dermis/rays/ray_scene.h"

namespace dermis::inline judge {
namespace {

// So dense that the distance to them is that to the cap's edge.
constexpr float kSpacingMm = 4;

void add_edge(Vec3 a, Vec3 b, std::vector<Vec3>& points_mm) {
    const int steps = std::max(1, int(std::ceil(length(b - a) / kSpacingMm)));
    for (int i = 0; i < steps; ++i) points_mm.push_back(a + (b - a) * (float(i) / float(steps)));
}

Result<std::vector<Vec3>> cut_points_mm(const Scene& scene) {
    DERMIS_TRY_ASSIGN(const std::vector<Flesh> all, find_flesh(scene.objects));
    std::vector<Vec3> points_mm;
    for (const Flesh& flesh : all) {
        if (flesh.is_sheet) continue;
        for (size_t i = flesh.cavity_caps; i < flesh.caps.size(); ++i)
            for (size_t k = 0; k < 3; ++k) add_edge(flesh.caps[i][k], flesh.caps[i][(k + 1) % 3], points_mm);
    }
    return points_mm;
}

}  // namespace

Result<Image> away_from_cuts(const Scene& scene, int width, int height) {
    DERMIS_TRY_ASSIGN(std::vector<Vec3> points_mm, cut_points_mm(scene));
    if (points_mm.empty()) return Image();
    const PointGrid cuts(std::move(points_mm), kCutMm);
    DERMIS_TRY_ASSIGN(const RayScene rays, RayScene::build(scene.objects));
    const Mat4 inverse = camera_matrices(scene.camera, float(width) / float(height)).inverse_view_projection;
    Image away(width, height, 1);
    std::atomic<bool> any_away = false;
    parallel_for(size_t(height), 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < size_t(width); ++x) {
                const Ray ray = camera_ray(inverse, float(x) + 0.5f, float(y) + 0.5f, width, height);
                const auto hit = rays.closest_hit(RaySet::opaque, ray);
                const bool near = hit && cuts.any_near(ray.origin_mm + ray.direction * hit->distance_mm);
                if (hit && !near) any_away = true;
                away.floats()[y * size_t(width) + x] = near ? 0 : 1;
            }
    });
    return any_away ? std::move(away) : Image();
}

}  // namespace dermis::inline judge
