#include "dermis/reference/walk_integrator.h"

#include "dermis/rays/flesh_boundary.h"
#include "dermis/rays/sampling.h"

namespace dermis::inline reference {

WalkIntegrator::Result WalkIntegrator::exitance(const DiffusePoint& point, uint32_t seed) const {
    Result result;
    Vec3 sum;
    // The channels lead in turn, the first by chance: each leads any walk as often.
    const uint32_t first_hero = hash_u32(seed, uint32_t(settings_.walks)) % 3;
    for (int i = 0; i < settings_.walks; ++i) {
        FleshBoundary boundary(rays_);
        Pcg32 random(seed, uint32_t(i));
        const auto hero = int((first_hero + uint32_t(i)) % 3);
        const Vec3 direction = sample_entry_direction(point.n_face, medium_.eta, random);
        const WalkEnd end =
            guided_walk(medium_, guide_, boundary, point.p_mm, point.n_face, direction, hero, random);
        result.lost += end.lost;
        if (end.lost || end.throughput == Vec3{}) continue;
        SurfaceAttributes surface = rays_.surface_at(boundary.last());
        surface.footprint = point.footprint;
        const Receiver receiver = lighting_.skin_receiver(surface, boundary.last());
        const LightingRandom uniform{random.next_2d(), random.next_2d(), random.next_1d()};
        sum += end.throughput * lighting_.irradiance(receiver, uniform);
    }
    const Vec3 n = settings_.normalisation;
    const float share = 1.0f / float(settings_.walks);
    result.exitance = {sum.x * share / n.x, sum.y * share / n.y, sum.z * share / n.z};
    return result;
}

}  // namespace dermis::inline reference
