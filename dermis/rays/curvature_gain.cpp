#include "dermis/rays/curvature_gain.h"

#include <array>
#include <cmath>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/rays/guided_walk.h"
#include "dermis/rays/rays_version.h"
#include "dermis/rays/sphere_boundary.h"

namespace dermis::inline rays {
namespace {

constexpr int kFormWalks = 1 << 14;
constexpr std::array kCurvatures = {-0.5, -0.25, -0.125, -0.0625, 0.0625, 0.125, 0.25, 0.5};

struct Moments {
    Rgb mean = {}, standard_error = {};
};

Moments moments(const std::vector<Vec3>& values) {
    Moments m;
    constexpr float Vec3::*kChannels[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0, squares = 0;
        for (const Vec3& v : values) {
            const double x = v.*kChannels[c];
            sum += x;
            squares += x * x;
        }
        const double n = double(values.size());
        m.mean[c] = sum / n;
        m.standard_error[c] = std::sqrt(std::max(squares / n - m.mean[c] * m.mean[c], 0.0) / n);
    }
    return m;
}

template <class Boundary>
Moments returned_light(const ScatteringMedium& medium, const Boundary& boundary, int walks, uint32_t seed) {
    const WalkMedium prepared = walk_medium(medium);
    const WalkGuide guide = walk_guide(medium);
    std::vector<Vec3> values(static_cast<size_t>(walks));
    parallel_for(values.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Pcg32 random(seed, uint32_t(i));
            const Vec3 up = {0, 0, 1}, start = sample_entry_direction(up, prepared.eta, random);
            values[i] =
                guided_walk(prepared, guide, boundary, {}, up, start, golden_1d(seed, uint32_t(i)), random)
                    .throughput;
        }
    });
    return moments(values);
}

}  // namespace

std::span<const double> gain_curvatures() {
    return kCurvatures;
}

WalkedGains walk_gain(const ScatteringMedium& medium, std::span<const double> curvatures_per_mm, int walks,
                      uint32_t seed) {
    const Moments flat = returned_light(medium, HalfSpace{}, 4 * walks, hash_u32(seed));
    WalkedGains gains{.flat = flat.mean};
    for (const double curvature : curvatures_per_mm) {
        const uint32_t own_seed = hash_u32(seed, uint32_t(gains.samples.size()) + 1);
        const Moments curved = returned_light(medium, SphereBoundary(curvature), walks, own_seed);
        GainSample sample{.curvature_per_mm = curvature};
        Rgb error = {0, 0, 0};
        for (size_t c = 0; c < 3; ++c) {
            if (!(flat.mean[c] > 0)) continue;
            sample.gain[c] = curved.mean[c] / flat.mean[c];
            error[c] =
                std::hypot(curved.standard_error[c], sample.gain[c] * flat.standard_error[c]) / flat.mean[c];
        }
        gains.samples.push_back(sample);
        gains.standard_errors.push_back(error);
    }
    return gains;
}

GainForm walked_gain_form(const ScatteringMedium& medium) {
    Hasher hasher;
    hasher.add(rays_version()).add(medium.g).add(medium.eta).add(kFormWalks);
    for (size_t c = 0; c < 3; ++c) hasher.add(medium.sigma_s_per_mm[c]).add(medium.sigma_a_per_mm[c]);
    GainForm form;
    if (const std::string hash = hasher.hex();
        !cache_load("gain_form", hash, std::tie(form.slope_mm, form.length_mm, form.bend_mm))) {
        const WalkedGains walked = walk_gain(medium, gain_curvatures(), kFormWalks, 1);
        form = fit_gain_form(walked.samples, walked.flat);
        cache_store("gain_form", hash, std::tie(form.slope_mm, form.length_mm, form.bend_mm));
    }
    return form;
}

}  // namespace dermis::inline rays
