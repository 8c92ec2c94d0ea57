#include "dermis/reference/walk_integrator.h"

#include "dermis/rays/random.h"

namespace dermis::inline reference {

Vec3 WalkIntegrator::entering(const FleshBoundary& boundary, const DiffusePoint& point,
                              const LightingChoice& light) const {
    SurfaceAttributes surface = rays_.surface_at(boundary.last());
    surface.footprint = point.footprint;
    return lighting_.irradiance(lighting_.skin_receiver(surface, boundary.last()), light);
}

WalkPair WalkIntegrator::walk(const DiffusePoint& point, FleshBoundary& boundary, float lead,
                              Pcg32 random) const {
    const Vec3 p_mm = point.p_mm, n = point.n_face;
    const Vec3 start = sample_entry_direction(n, medium_.eta, random);
    if (settings_.subtracts_flat)
        return guided_walk_and_flat(medium_, guide_, boundary, p_mm, n, start, lead, random);
    return {guided_walk(medium_, guide_, boundary, p_mm, n, start, lead, random), {}};
}

WalkIntegrator::Result WalkIntegrator::exitance(const DiffusePoint& point, const Receiver& receiver,
                                                Vec3 irradiance, uint32_t seed) const {
    Result result;
    Vec3 sum;
    const uint32_t first = hash_u32(seed, uint32_t(settings_.walks));
    for (int i = 0; i < settings_.walks; ++i) {
        FleshBoundary boundary(rays_);
        const auto [end, flat] =
            walk(point, boundary, golden_1d(first, uint32_t(i)), Pcg32(seed, uint32_t(i)));
        result.lost += end.lost;
        // Both ends under the same point of the lights.
        OwenSequence points(hash_u32(seed, 2), uint32_t(i));
        const Vec2 penumbra = points.next_2d(), environment = points.next_2d();
        const LightingChoice light = lighting_.choose({penumbra, environment, points.next_1d()});
        if (end.throughput != Vec3{}) sum += end.throughput * entering(boundary, point, light);
        if (flat.throughput != Vec3{}) sum -= flat.throughput * lighting_.irradiance(receiver, light);
    }
    const Vec3 n = settings_.normalisation;
    const float share = 1.0f / float(settings_.walks);
    result.exitance = {sum.x * share / n.x, sum.y * share / n.y, sum.z * share / n.z};
    if (settings_.subtracts_flat) result.exitance += irradiance;
    return result;
}

}  // namespace dermis::inline reference
