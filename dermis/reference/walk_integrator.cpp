#include "dermis/reference/walk_integrator.h"

#include "dermis/rays/sampling.h"

namespace dermis {
namespace {

// The skin's triangles as a boundary; remembers the last one met, for its attributes.
class SkinBoundary {
  public:
    explicit SkinBoundary(const RayScene& rays)
        : rays_(rays), box_(rays.bounds(RaySet::skin)), least_mm_(4 * rays.epsilon_mm()) {}

    std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm) const {
        const auto hit = rays_.closest_hit(
            RaySet::skin, {.origin_mm = p_mm, .direction = direction, .min_mm = least_mm_, .max_mm = max_mm});
        // Past the box the path came out through a hole: a boundary met from its back, which ends it as lost.
        if (!hit && !inside_box(p_mm + direction * max_mm)) return BoundaryHit{max_mm, -direction};
        if (!hit) return std::nullopt;
        last_ = *hit;
        return BoundaryHit{hit->distance_mm, hit->n_face};
    }
    [[nodiscard]] const RayHit& last() const { return last_; }

  private:
    [[nodiscard]] bool inside_box(Vec3 p) const {
        const Vec3 a = box_.min_mm, b = box_.max_mm;
        return p.x >= a.x && p.y >= a.y && p.z >= a.z && p.x <= b.x && p.y <= b.y && p.z <= b.z;
    }

    const RayScene& rays_;
    RayScene::Bounds box_;
    float least_mm_;
    mutable RayHit last_;
};

}  // namespace

WalkIntegrator::Result WalkIntegrator::exitance(const DiffusePoint& point, Vec3 n_face, uint32_t seed) const {
    Result result;
    Vec3 sum;
    const SkinBoundary boundary(rays_);
    for (int i = 0; i < settings_.walks; ++i) {
        Pcg32 random(seed, uint32_t(i));
        const Vec3 direction = sample_entry_direction(n_face, medium_.eta, random);
        const WalkEnd end = random_walk(medium_, boundary, point.p_mm, direction, random);
        result.lost += end.lost;
        if (end.lost || end.throughput == Vec3{}) continue;
        SurfaceAttributes surface = rays_.surface_at(boundary.last());
        surface.footprint = point.footprint;
        const uint32_t object = boundary.last().object;
        const Receiver receiver{.p_smooth_mm = surface.p_smooth_mm,
                                .n_geometry = surface.n_geometry_world,
                                .n = materials_.normal_at(surface, object),
                                .occlusion = materials_.occlusion_at(surface, boundary.last())};
        const LightingRandom uniform{random.next_2d(), random.next_2d(), random.next_1d()};
        sum += end.throughput * lighting_.irradiance(receiver, uniform);
    }
    const Vec3 n = settings_.normalisation;
    const float share = 1.0f / float(settings_.walks);
    result.exitance = {sum.x * share / n.x, sum.y * share / n.y, sum.z * share / n.z};
    return result;
}

}  // namespace dermis
