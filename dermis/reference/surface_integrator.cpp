#include "dermis/reference/surface_integrator.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/angle.h"
#include "dermis/base/parallel.h"
#include "dermis/rays/random.h"
#include "dermis/rays/sampling.h"
#include "dermis/reference/way_through_flesh.h"

namespace dermis::inline reference {
namespace {

// The share of probes along each of the two tangents: these find surfaces nearly parallel to the normal,
// which are rare, and mostly meet far skin of little weight.
constexpr float kTangentShare = 1.0f / 16;
constexpr size_t kMostHits = 32;
// Russian roulette: a point whose weight is less than this many times the typical weight is evaluated with
// the probability of that ratio only.
constexpr float kFullWeight = 0.1f;
// Of a plane's. Where it is less, as on the point of a needle or between surfaces that cross, single probes
// would make the series' terms too large.
constexpr float kLeastReflectance = 0.5f;

float most(Vec3 v) {
    return std::max({v.x, v.y, v.z});
}

std::array<LocalFrame, 3> axes_around(Vec3 normal) {
    const LocalFrame f = frame_of(normal);
    return {f, {f.bitangent, f.normal, f.tangent}, {f.normal, f.tangent, f.bitangent}};
}

float axis_share(size_t axis) {
    return axis == 0 ? 1 - 2 * kTangentShare : kTangentShare;
}

Vec3 quotient(Vec3 a, Vec3 b) {
    return {a.x / b.x, a.y / b.y, a.z / b.z};
}

// Mean of n (1 + x + x^2) by the means of each run; the factors of a product are of different runs.
Vec3 series(const std::array<Vec3, kRuns>& n, const std::array<Vec3, kRuns>& x) {
    Vec3 sum;
    for (size_t i = 0; i < kRuns; ++i) {
        const Vec3 a = x[(i + 1) % kRuns], b = x[(i + 2) % kRuns];
        sum += n[i] * (Vec3{1, 1, 1} + (a + b) * 0.5f + a * b);
    }
    return sum * (1.0f / kRuns);
}

}  // namespace

// Of all axes together: the balance heuristic for one sample (Veach, Guibas 1995).
float SurfaceIntegrator::probe_density(const Axes& axes, Vec3 offset_mm, Vec3 n_face) const {
    float sum = 0;
    for (size_t i = 0; i < axes.size(); ++i) {
        const Vec3 axis = axes[i].normal;
        const float along = dot(offset_mm, axis);
        const float radius_mm = std::sqrt(std::max(0.0f, dot(offset_mm, offset_mm) - along * along));
        sum += axis_share(i) * profile_.density_per_mm2(radius_mm) * std::abs(dot(n_face, axis));
    }
    return sum;
}

std::span<const RayHit> SurfaceIntegrator::probe_hits(const DiffusePoint& point, const LocalFrame& disk,
                                                      Vec2 radius_mm_and_angle_rad,
                                                      std::span<RayHit> hits) const {
    const auto [radius_mm, angle_rad] = radius_mm_and_angle_rad;
    const float half_mm =
        std::sqrt(std::max(0.0f, profile_.max_mm() * profile_.max_mm() - radius_mm * radius_mm));
    const Vec3 middle_mm =
        point.p_mm + disk.to_world({radius_mm * std::cos(angle_rad), radius_mm * std::sin(angle_rad), 0});
    return hits.first(rays_.all_hits(
        RaySet::skin,
        {.origin_mm = middle_mm + disk.normal * half_mm, .direction = -disk.normal, .max_mm = 2 * half_mm},
        hits));
}

template <class Found>
Vec3 SurfaceIntegrator::probe(const DiffusePoint& point, const Probe& of, const Found& found) const {
    HitBuffer<kMostHits> buffer;
    Pcg32 chance(of.seed, of.index);
    OwenSequence even(of.seed, of.index);
    const Vec2 u = even.next_2d();
    const float choice = even.next_1d() / kTangentShare;
    const size_t axis = choice < 1 ? 1 : choice < 2 ? 2 : 0;
    const float radius_mm = profile_.sample_radius_mm(u.x);
    for (const RayHit& hit : probe_hits(point, of.axes[axis], {radius_mm, 2 * kPi * u.y}, buffer.hits())) {
        SurfaceAttributes surface = rays_.surface_at(hit);
        surface.footprint = point.footprint;
        const Vec3 offset_mm = surface.p_world_mm - point.p_mm;
        const float density = probe_density(of.axes, offset_mm, hit.n_face);
        if (density <= 0) continue;
        // First by the straight distance, which is at most the way through flesh and needs no rays.
        const float straight_weight = most(profile_.reflectance(length(offset_mm))) / density;
        const float survival = std::min(1.0f, straight_weight / kFullWeight);
        if (survival <= 0 || chance.next_1d() >= survival) continue;
        const float way_mm = way_through_flesh_mm(rays_, {point.p_mm, point.n_face},
                                                  {surface.p_world_mm, hit.n_face}, profile_.max_mm());
        if (way_mm > profile_.max_mm()) continue;
        found(profile_.reflectance(way_mm) * (1 / (density * survival)), surface, hit);
    }
    const float density = axis_share(0) * profile_.density_per_mm2(radius_mm);
    const bool on_plane = axis == 0 && density > 0;
    return profile_.total() - (on_plane ? profile_.reflectance(radius_mm) * (1 / density) : Vec3{});
}

LightingRandom lighting_random(uint32_t seed, uint32_t index) {
    OwenSequence uniform(hash_u32(seed, 1), index);
    const Vec2 penumbra = uniform.next_2d(), environment = uniform.next_2d();
    return {penumbra, environment, uniform.next_1d()};
}

Vec3 mean_irradiance(const Lighting& lighting, const Receiver& receiver, uint32_t seed, int count,
                     uint32_t first) {
    if (lighting.is_exact()) return lighting.irradiance(receiver, {});
    Vec3 sum;
    for (int i = 0; i < count; ++i)
        sum += lighting.irradiance(receiver, lighting.choose(lighting_random(seed, first + uint32_t(i))));
    return sum * (1 / float(count));
}

Vec3 SurfaceIntegrator::reflectance_around(const DiffusePoint& point, int probes, uint32_t seed) const {
    const Axes axes = axes_around(point.n_geometry);
    Vec3 sum;
    for (int i = 0; i < probes; ++i) {
        const auto add = [&](Vec3 weight, const SurfaceAttributes&, const RayHit&) { sum += weight; };
        sum += probe(point, {axes, seed, uint32_t(i)}, add);
    }
    const Vec3 mean = sum * (1 / float(probes)), least = profile_.total() * kLeastReflectance;
    // Above 0 in a channel that reflects nothing too.
    const auto at_least = [](float a, float b) { return std::max({a, b, 1e-30f}); };
    return {at_least(mean.x, least.x), at_least(mean.y, least.y), at_least(mean.z, least.z)};
}

SurfaceIntegrator::Result SurfaceIntegrator::estimate(const DiffusePoint& point, const Receiver& receiver,
                                                      Vec3 reflectance, SampleRandom random) const {
    const Axes axes = axes_around(point.n_geometry);
    const bool exact = lighting_.is_exact(), divides = settings_.normalisation == Normalisation::by_area;
    const auto count = uint32_t(settings_.probes_of_run);
    const float share = 1 / float(count);
    Vec3 own = exact ? lighting_.irradiance(receiver, {}) : Vec3{}, sum_of_own;
    std::array<Vec3, kRuns> found, rest;
    uint32_t number = random.first_light;
    for (uint32_t run = 0; run < kRuns; ++run) {
        Vec3 n, d;
        for (uint32_t i = 0; i < count; ++i) {
            const LightingChoice light = lighting_.choose(lighting_random(random.seed, number++));
            if (!exact) own = lighting_.irradiance(receiver, light);
            sum_of_own += own;
            d += probe(point, {axes, hash_u32(random.seed, 2, run), random.index * count + i},
                       [&](Vec3 weight, const SurfaceAttributes& surface, const RayHit& hit) {
                           const Vec3 from =
                               lighting_.irradiance(lighting_.skin_receiver(surface, hit), light);
                           n += weight * (divides ? from - own : from);
                           d += weight;
                       });
        }
        found[run] = n * share;
        rest[run] = Vec3{1, 1, 1} - quotient(d * share, reflectance);
    }
    own = sum_of_own * (share / kRuns);
    if (!divides) return {own, (found[0] + found[1] + found[2]) * (1.0f / kRuns) - own};
    return {own, quotient(series(found, rest), reflectance)};
}

Estimate estimate_exitance(const SurfaceIntegrator& integrator, const DiffusePoint& point,
                           const Receiver& receiver, int estimates, uint32_t seed) {
    constexpr int kReflectanceProbes = 256;
    const Vec3 reflectance = integrator.reflectance_around(point, kReflectanceProbes, hash_u32(seed));
    std::vector<Vec3> values(static_cast<size_t>(estimates));
    parallel_for(values.size(), 4, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            values[i] = integrator.estimate(point, receiver, reflectance, {hash_u32(seed, uint32_t(i)), 0, 0})
                            .exitance();
    });
    const auto channel = [&](float Vec3::*c, float& mean_out, float& error_out) {
        double mean = 0, squares = 0;
        for (const Vec3& v : values) mean += v.*c;
        mean /= double(values.size());
        for (const Vec3& v : values) squares += (v.*c - mean) * (v.*c - mean);
        mean_out = float(mean);
        error_out =
            float(std::sqrt(squares / double(values.size()) / std::max(1.0, double(values.size()) - 1)));
    };
    Estimate result;
    for (float Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z})
        channel(c, result.mean.*c, result.standard_error.*c);
    return result;
}

}  // namespace dermis::inline reference
