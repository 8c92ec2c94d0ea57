#include "dermis/rays/random_walk.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/optics/fresnel.h"

namespace dermis::inline rays {
namespace {

// Throughput below which roulette begins: saves work on dim paths without making rare bright ones.
constexpr float kRouletteBelow = 0.1f;
constexpr int kMostEntryTries = 256;

Vec3 exp_of(Vec3 v) {
    return {std::exp(v.x), std::exp(v.y), std::exp(v.z)};
}

float fresnel_from_inside(float cosine, float eta) {
    return eta == 1 ? 0.0f : float(fresnel_dielectric(cosine, 1 / double(eta)));
}

}  // namespace

Vec3 hero_chances(Vec3 throughput) {
    const float sum = throughput.x + throughput.y + throughput.z;
    return sum > 0 ? throughput * (1 / sum) : Vec3{1.0f / 3, 1.0f / 3, 1.0f / 3};
}

WalkMedium walk_medium(const ScatteringMedium& medium) {
    const auto channel = [&](int c) { return float(medium.sigma_s_per_mm[size_t(c)]); };
    const auto total = [&](int c) { return float(sigma_t_per_mm(medium, c)); };
    return {.sigma_s_per_mm = {channel(0), channel(1), channel(2)},
            .sigma_t_per_mm = {total(0), total(1), total(2)},
            .g = float(medium.g),
            .eta = float(medium.eta)};
}

Vec3 sample_entry_direction(Vec3 n_out, float eta, Pcg32& random) {
    const LocalFrame frame = frame_of(-n_out);
    Vec3 local{0, 0, 1};
    for (int i = 0; i < kMostEntryTries; ++i) {
        local = sample_cosine_hemisphere(random.next_2d());
        if (eta == 1 || random.next_1d() >= fresnel_from_inside(local.z, eta)) break;
    }
    return frame.to_world(local);
}

Flight sample_flight(const WalkMedium& medium, Vec3 throughput, Pcg32& random) {
    const Vec3 chance = hero_chances(throughput);
    const float u = random.next_1d();
    const int hero = u < chance.x ? 0 : u < chance.x + chance.y ? 1 : 2;
    const float sigma[3] = {medium.sigma_t_per_mm.x, medium.sigma_t_per_mm.y, medium.sigma_t_per_mm.z};
    return {sample_exponential_mm(random.next_1d(), sigma[hero]), hero};
}

Vec3 pass_weight(const WalkMedium& medium, Vec3 throughput, float distance_mm) {
    const Vec3 passing = exp_of(medium.sigma_t_per_mm * -distance_mm);
    const float density = dot(hero_chances(throughput), passing);
    return density > 0 ? throughput * passing * (1 / density) : Vec3{};
}

Vec3 scatter_weight(const WalkMedium& medium, Vec3 throughput, float distance_mm) {
    const Vec3 passing = exp_of(medium.sigma_t_per_mm * -distance_mm);
    const float density = dot(hero_chances(throughput), medium.sigma_t_per_mm * passing);
    return density > 0 ? throughput * medium.sigma_s_per_mm * passing * (1 / density) : Vec3{};
}

bool survives_roulette(Vec3& throughput, Pcg32& random) {
    const float most = std::max({throughput.x, throughput.y, throughput.z});
    if (most >= kRouletteBelow) return true;
    const float chance = most / kRouletteBelow;
    if (random.next_1d() >= chance) return false;
    throughput *= 1 / chance;
    return true;
}

std::optional<Vec3> reflected_at(const BoundaryHit& hit, Vec3 direction, float eta, Pcg32& random) {
    const float cosine = dot(direction, hit.n_out);
    if (!hit.mirror && (eta == 1 || random.next_1d() >= fresnel_from_inside(cosine, eta)))
        return std::nullopt;
    return normalize(direction - hit.n_out * (2 * cosine));
}

HalfSpaceAlbedo mean_of(std::span<const Vec3> values) {
    const auto count = double(values.size());
    HalfSpaceAlbedo result;
    for (float Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        double sum = 0, squares = 0;
        for (const Vec3& v : values) {
            sum += v.*c;
            squares += double(v.*c) * v.*c;
        }
        const double mean = sum / count;
        result.mean.*c = float(mean);
        result.standard_error.*c = float(std::sqrt(std::max(0.0, squares / count - mean * mean) / count));
    }
    return result;
}

HalfSpaceAlbedo half_space_albedo(const ScatteringMedium& medium, std::optional<Vec3> start, int walks,
                                  uint32_t seed) {
    const WalkMedium prepared = walk_medium(medium);
    std::vector<Vec3> values(static_cast<size_t>(walks));
    parallel_for(values.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Pcg32 random(seed, uint32_t(i));
            const Vec3 direction = start ? *start : sample_entry_direction({0, 0, 1}, prepared.eta, random);
            values[i] = random_walk(prepared, HalfSpace{}, {}, direction, random).throughput;
        }
    });
    return mean_of(values);
}

}  // namespace dermis::inline rays
