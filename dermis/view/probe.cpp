#include "dermis/view/probe.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dermis::view {
namespace {

// From the eye through a point of the picture, computed on the far plane.
Ray ray_through(const Camera& camera, Vec2 place, float aspect) {
    const Mat4 m = camera_matrices(camera, aspect).inverse_view_projection;
    const float clip[4] = {place.x * 2 - 1, place.y * 2 - 1, 1, 1};
    float world[4] = {};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) world[row] += m.m[4 * column + row] * clip[column];
    const Vec3 far_mm = Vec3{world[0], world[1], world[2]} * (1 / world[3]);
    return {.origin_mm = camera.eye_mm, .direction = normalize(far_mm - camera.eye_mm)};
}

// More than the thickness of any head.
constexpr float kMaxThicknessMm = 400;

}  // namespace

Result<Probe> Probe::create(const Scene& scene) {
    DERMIS_TRY_ASSIGN(RayScene rays, RayScene::build(scene.objects));
    return Probe(std::move(rays), scene);
}

float Probe::curvature_at(const RayHit& hit) const {
    const Mesh& mesh = scene_->objects[hit.object].mesh;
    if (mesh.curvatures_per_mm.size() != mesh.positions_mm.size()) return 0;
    const auto corner = [&](uint32_t k) {
        return mean_curvature(mesh.curvatures_per_mm[mesh.indices[3 * hit.triangle + k]]);
    };
    return corner(0) * (1 - hit.u - hit.v) + corner(1) * hit.u + corner(2) * hit.v;
}

std::optional<ProbeReading> Probe::at(const Camera& camera, Vec2 place, float aspect) const {
    const std::optional<RayHit> hit = rays_.closest_hit(RaySet::opaque, ray_through(camera, place, aspect));
    if (!hit) return {};
    const SurfaceAttributes surface = rays_.surface_at(*hit);
    ProbeReading reading = {.p_world_mm = surface.p_world_mm,
                            .curvature_per_mm = curvature_at(*hit),
                            .material = scene_->objects[hit->object].mesh.materials[surface.material].name};
    const Ray inwards = {.origin_mm = surface.p_world_mm,
                         .direction = -surface.n_geometry_world,
                         .min_mm = 100 * rays_.epsilon_mm(),
                         .max_mm = kMaxThicknessMm};
    if (const auto other_side = rays_.closest_hit(RaySet::opaque, inwards))
        reading.thickness_mm = other_side->distance_mm;
    return reading;
}

std::string probe_text(const ProbeReading& reading) {
    char text[160];
    const float curvature = reading.curvature_per_mm;
    int length = std::snprintf(text, sizeof text, "curvature %+.4f /mm", curvature);
    if (std::abs(curvature) > 1e-4f)
        length += std::snprintf(text + length, sizeof text - size_t(length), " (radius %.1f mm)",
                                1 / std::abs(curvature));
    if (reading.thickness_mm)
        length += std::snprintf(text + length, sizeof text - size_t(length), "   thickness %.1f mm",
                                *reading.thickness_mm);
    return std::string(text, size_t(length)) + (reading.material.empty() ? "" : "   " + reading.material);
}

}  // namespace dermis::view
