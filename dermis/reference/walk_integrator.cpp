#include "dermis/reference/walk_integrator.h"

#include "dermis/rays/random.h"

namespace dermis::inline reference {

Vec3 WalkIntegrator::entering(const FleshBoundary& boundary, const DiffusePoint& point,
                              const LightingRandom& uniform) const {
    SurfaceAttributes surface = rays_.surface_at(boundary.last());
    surface.footprint = point.footprint;
    return lighting_.irradiance(lighting_.skin_receiver(surface, boundary.last()), uniform);
}

WalkIntegrator::Effect WalkIntegrator::effect(const DiffusePoint& point, const Receiver& receiver,
                                              uint32_t seed) const {
    Effect result;
    const uint32_t first = hash_u32(seed, uint32_t(settings_.walks));
    for (int i = 0; i < settings_.walks; ++i) {
        Pcg32 random(seed, uint32_t(i));
        const Vec3 direction = sample_entry_direction(point.n_face, medium_.eta, random);
        FleshBoundary boundary(rays_);
        const float lead = golden_1d(first, uint32_t(i));
        const auto [end, flat] = settings_.normalisation == Normalisation::by_area
                                     ? guided_walk_and_flat(medium_, guide_, boundary, point.p_mm,
                                                            point.n_face, direction, lead, random)
                                     : WalkPair{guided_walk(medium_, guide_, boundary, point.p_mm,
                                                            point.n_face, direction, lead, random),
                                                {}};
        result.lost += end.lost;
        // Both ends under the same point of the lights.
        OwenSequence points(hash_u32(seed, 2), uint32_t(i));
        const Vec2 penumbra = points.next_2d(), environment = points.next_2d();
        const LightingRandom uniform{penumbra, environment, points.next_1d()};
        if (end.throughput != Vec3{}) result.sum += end.throughput * entering(boundary, point, uniform);
        if (flat.throughput != Vec3{})
            result.sum -= flat.throughput * lighting_.irradiance(receiver, uniform);
    }
    return result;
}

WalkIntegrator::Result WalkIntegrator::exitance(const DiffusePoint& point, const Receiver& receiver,
                                                Vec3 irradiance, uint32_t seed) const {
    const Effect walked = effect(point, receiver, seed);
    const Vec3 mean = walked.sum * (1.0f / float(settings_.walks)), a = settings_.albedo;
    if (settings_.normalisation == Normalisation::none) return {mean, walked.lost};
    return {irradiance + Vec3{mean.x / a.x, mean.y / a.y, mean.z / a.z}, walked.lost};
}

}  // namespace dermis::inline reference
