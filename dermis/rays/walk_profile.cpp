#include "dermis/rays/walk_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "dermis/base/parallel.h"
#include "dermis/rays/guided_walk.h"

namespace dermis::inline rays {
namespace {

constexpr double kRingRatio = 1.09;
constexpr int kLeastWalks = 3000;
constexpr size_t kWalksOfBlock = 3000;  // a multiple of the three channels that lead
constexpr size_t kRounds = 20;          // between two reports of progress

// Ring 0 is a disk; light beyond the last ring is left out.
struct Rings {
    double least_mm;
    size_t count;

    [[nodiscard]] double outer_mm(size_t ring) const { return least_mm * std::pow(kRingRatio, double(ring)); }
    [[nodiscard]] double inner_mm(size_t ring) const { return ring == 0 ? 0 : outer_mm(ring - 1); }
    [[nodiscard]] size_t of(double r_mm) const {
        if (r_mm <= least_mm) return 0;
        return size_t(std::ceil(std::log(r_mm / least_mm) / std::log(kRingRatio)));
    }
};

// From a hundredth of the shortest mean free path to where the widest channel has no light.
Rings rings_of(const ScatteringMedium& medium) {
    double shortest = 1e30, widest = 0;
    for (int c = 0; c < 3; ++c) {
        const double path_mm = 1 / reduced_sigma_t_per_mm(medium, c);
        const double nu = diffusion_length_in_paths(reduced_albedo(medium, c));
        shortest = std::min(shortest, path_mm);
        widest = std::max(widest, path_mm * nu);
    }
    constexpr double kNearest = 0.01, kFarthest = 16;
    const Rings one{kNearest * shortest, 0};
    return {one.least_mm, one.of(kFarthest * widest) + 1};
}

struct Light {
    Rgb all = {0, 0, 0};
    std::vector<Rgb> rings;
};

Light walk_block(const WalkMedium& medium, const WalkGuide& guide, const Rings& rings, uint32_t seed,
                 size_t first) {
    Light light{.rings = std::vector<Rgb>(rings.count, Rgb{0, 0, 0})};
    const Vec3 n{0, 0, 1};
    for (size_t i = first; i < first + kWalksOfBlock; ++i) {
        Pcg32 random(seed, uint32_t(i));
        const Vec3 start = sample_entry_direction(n, medium.eta, random);
        const WalkEnd end =
            guided_walk(medium, guide, HalfSpace{}, {}, n, start, golden_1d(seed, uint32_t(i)), random);
        const size_t ring = rings.of(std::hypot(end.p_mm.x, end.p_mm.y));
        const float carried[3] = {end.throughput.x, end.throughput.y, end.throughput.z};
        for (size_t c = 0; c < 3; ++c) {
            light.all[c] += double(carried[c]);
            if (ring < rings.count) light.rings[ring][c] += double(carried[c]);
        }
    }
    return light;
}

// Blocks are added in their order: the result does not depend on the threads.
Light walk_all(const ScatteringMedium& medium, const Rings& rings, size_t blocks, uint32_t seed,
               const WalkProfileProgress& progress) {
    const WalkMedium prepared = walk_medium(medium);
    const WalkGuide guide = walk_guide(medium);
    Light sum{.rings = std::vector<Rgb>(rings.count, Rgb{0, 0, 0})};
    const size_t round = std::max<size_t>(1, blocks / kRounds);
    for (size_t done = 0; done < blocks; done += round) {
        std::vector<Light> made(std::min(round, blocks - done));
        parallel_for(made.size(), 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                made[i] = walk_block(prepared, guide, rings, seed, (done + i) * kWalksOfBlock);
        });
        for (const Light& light : made)
            for (size_t c = 0; c < 3; ++c) {
                sum.all[c] += light.all[c];
                for (size_t k = 0; k < rings.count; ++k) sum.rings[k][c] += light.rings[k][c];
            }
        if (progress) progress(double(done + made.size()) / double(blocks));
    }
    return sum;
}

Result<Profile> table_of(const Light& light, const Rings& rings, double walks, const std::string& source) {
    std::vector<double> radii_mm;
    std::vector<Rgb> values;
    for (size_t k = 0; k < rings.count; ++k) {
        const double in_mm = rings.inner_mm(k), out_mm = rings.outer_mm(k);
        const double area_mm2 = std::numbers::pi * (out_mm * out_mm - in_mm * in_mm);
        radii_mm.push_back(k == 0 ? 0.5 * out_mm : std::sqrt(in_mm * out_mm));
        Rgb value;
        for (size_t c = 0; c < 3; ++c) value[c] = light.rings[k][c] / (walks * area_mm2);
        values.push_back(value);
    }
    const auto table = [&] { return TabulatedProfile::make(radii_mm, values, "walks"); };
    DERMIS_TRY_ASSIGN(const TabulatedProfile raw, table());
    // Straight lines between the rings have a little more light than the walks.
    Rgb factor;
    for (int c = 0; c < 3; ++c) {
        const double has = raw.moment_within(c, 0, radii_mm.back());
        factor[size_t(c)] = has > 0 ? light.all[size_t(c)] / walks / has : 0;
    }
    for (Rgb& value : values)
        for (size_t c = 0; c < 3; ++c) value[c] *= factor[c];
    DERMIS_TRY_ASSIGN(const TabulatedProfile made, table());
    return Profile{.name = "walks", .source = source, .model = made};
}

}  // namespace

Result<Profile> fit_walk_profile(const ScatteringMedium& medium, int walks, uint32_t seed,
                                 const WalkProfileProgress& progress) {
    DERMIS_TRY(check(medium));
    if (walks < kLeastWalks)
        return Error{"walks is " + std::to_string(walks) + ", must be " + std::to_string(kLeastWalks) +
                     " or more"};
    const size_t blocks = (size_t(walks) + kWalksOfBlock - 1) / kWalksOfBlock;
    const Rings rings = rings_of(medium);
    const Light light = walk_all(medium, rings, blocks, seed, progress);
    return table_of(light, rings, double(blocks * kWalksOfBlock),
                    std::to_string(blocks * kWalksOfBlock) + " walks in a half-space, diffuse light");
}

ProfileError error_of(const Profile& profile, const Profile& by_walks, int channel) {
    const double r90_mm = inverse_cdf_mm(by_walks, channel, 0.9);
    ProfileError error{.albedo_ratio = diffuse_albedo(profile, channel) / diffuse_albedo(by_walks, channel),
                       .mean_ratio = mean_radius_mm(profile, channel) / mean_radius_mm(by_walks, channel),
                       .r90_ratio = inverse_cdf_mm(profile, channel, 0.9) / r90_mm,
                       .light_at_distance = 0};
    constexpr int kRadii = 400;
    for (int i = 1; i <= kRadii; ++i) {
        const double r_mm = 3 * r90_mm * i / kRadii;
        const double difference = cdf(profile, channel, r_mm) - cdf(by_walks, channel, r_mm);
        error.light_at_distance = std::max(error.light_at_distance, std::abs(difference));
    }
    return error;
}

}  // namespace dermis::inline rays
