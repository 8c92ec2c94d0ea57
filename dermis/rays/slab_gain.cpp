#include "dermis/rays/slab_gain.h"

#include <array>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/optics/conversions.h"
#include "dermis/rays/guided_walk.h"
#include "dermis/rays/rays_version.h"

namespace dermis::inline rays {
namespace {

constexpr int kSlabWalks = 1 << 13;
constexpr std::array kMeanRadii = {0.25, 0.5, 1.0, 2.0};

// Light enters at z = 0.
struct SlabBoundary {
    float thickness_mm;

    std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm) const {
        if (direction.z == 0) return std::nullopt;
        const bool up = direction.z > 0;
        const float to_plane_mm = up ? std::max(-p_mm.z, 0.0f) : std::max(p_mm.z + thickness_mm, 0.0f);
        const float distance_mm = to_plane_mm / std::abs(direction.z);
        if (distance_mm > max_mm) return std::nullopt;
        return BoundaryHit{distance_mm, {0, 0, up ? 1.0f : -1.0f}};
    }
};

double channel_of(Vec3 v, int channel) {
    return channel == 0 ? v.x : channel == 1 ? v.y : v.z;
}

}  // namespace

double slab_passes(const Profile& profile, int channel, double thickness_mm) {
    const double t = slab_transmittance(profile, channel, thickness_mm);
    return t / (1 + t);
}

double walked_slab_passes(const Profile& profile, int channel, double thickness_mm, int walks,
                          uint32_t seed) {
    const ScatteringMedium medium = walk_medium_of(profile);
    const WalkMedium prepared = walk_medium(medium);
    const WalkGuide guide = walk_guide(medium);
    const auto count = static_cast<size_t>(walks);
    std::vector<double> through(count), returned(count);
    parallel_for(count, 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Pcg32 random(seed, uint32_t(i));
            const Vec3 up = {0, 0, 1}, start = sample_entry_direction(up, prepared.eta, random);
            const auto walked = [&](const auto& boundary) {
                return guided_walk(prepared, guide, boundary, {}, up, start, golden_1d(seed, uint32_t(i)),
                                   random);
            };
            const WalkEnd slab = walked(SlabBoundary{float(thickness_mm)});
            if (slab.p_mm.z < -0.5f * float(thickness_mm)) through[i] = channel_of(slab.throughput, channel);
            returned[i] = channel_of(walked(HalfSpace{}).throughput, channel);
        }
    });
    double of_slab = 0, of_half_space = 0;
    for (size_t i = 0; i < count; ++i) {
        of_slab += through[i];
        of_half_space += returned[i];
    }
    return of_half_space > 0 ? of_slab / of_half_space : 0;
}

Rgb walked_slab_gain(const Profile& profile) {
    Hasher hasher;
    const ScatteringMedium medium = walk_medium_of(profile);
    hasher.add(rays_version()).add(medium.g).add(medium.eta).add(kSlabWalks);
    for (size_t c = 0; c < 3; ++c) {
        hasher.add(medium.sigma_s_per_mm[c]).add(medium.sigma_a_per_mm[c]);
        for (const double radii : kMeanRadii)
            hasher.add(slab_passes(profile, int(c), radii * mean_radius_mm(profile, int(c))));
    }
    Rgb gain = {1, 1, 1};
    const std::string hash = hasher.hex();
    if (cache_load("slab_gain", hash, std::tie(gain))) return gain;
    for (int c = 0; c < 3; ++c) {
        double walked = 0, by_profile = 0;
        for (const double radii : kMeanRadii) {
            const double thickness_mm = radii * mean_radius_mm(profile, c);
            walked += walked_slab_passes(profile, c, thickness_mm, kSlabWalks, 1);
            by_profile += slab_passes(profile, c, thickness_mm);
        }
        if (walked > 0 && by_profile > 0) gain[size_t(c)] = walked / by_profile;
    }
    cache_store("slab_gain", hash, std::tie(gain));
    return gain;
}

}  // namespace dermis::inline rays
