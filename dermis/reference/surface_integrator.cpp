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

// Probes of a half for each probe along one of the two tangents: these find surfaces nearly parallel to the
// normal, which are rare, and mostly meet far skin of little weight.
constexpr uint32_t kProbesPerTangent = 16;
constexpr size_t kMostHits = 32;
// Russian roulette: a point whose weight is less than this many times the typical weight is evaluated with
// the probability of that ratio only.
constexpr float kFullWeight = 0.1f;

float most(Vec3 v) {
    return std::max({v.x, v.y, v.z});
}

float quotient(float a, float b) {
    return b > 0 ? a / b : 0;
}
Vec3 quotient(Vec3 a, Vec3 b) {
    return {quotient(a.x, b.x), quotient(a.y, b.y), quotient(a.z, b.z)};
}

// The quotient of all probes, less its bias. The bias is as the variance of the sums, which falls faster than
// 1/n with these points: in a half it is about 2.33 times that of the whole (spheres of 2 mm, 16 to 64
// probes). Where all probes of a half missed, the plain quotient is used.
constexpr float kOfTheDifference = 1 / (2.33f - 1);
float jackknife(float all, float first, float second, float first_weight, float second_weight) {
    if (first_weight <= 0 || second_weight <= 0) return all;
    return all + kOfTheDifference * (all - 0.5f * (first + second));
}

}  // namespace

SurfaceIntegrator::Disks SurfaceIntegrator::disks_around(Vec3 normal) const {
    const LocalFrame f = frame_of(normal);
    const uint32_t half = uint32_t(settings_.probes) / 2;
    const uint32_t along_tangent = std::max(1u, half / kProbesPerTangent);
    return {{{f, half - 2 * along_tangent},
             {{f.bitangent, f.normal, f.tangent}, along_tangent},
             {{f.normal, f.tangent, f.bitangent}, along_tangent}}};
}

// Of all disks' probes together: the balance heuristic (Veach, Guibas 1995) by their true numbers.
float SurfaceIntegrator::probe_density(const Disks& disks, Vec3 offset_mm, Vec3 n_face) const {
    float sum = 0;
    for (const Disk& disk : disks) {
        const float along = dot(offset_mm, disk.frame.normal);
        const float radius_mm = std::sqrt(std::max(0.0f, dot(offset_mm, offset_mm) - along * along));
        sum += float(disk.probes) * profile_.density_per_mm2(radius_mm) *
               std::abs(dot(n_face, disk.frame.normal));
    }
    return sum / float(settings_.probes / 2);
}

std::span<const RayHit> SurfaceIntegrator::probe_hits(const DiffusePoint& point, const LocalFrame& disk,
                                                      Vec2 u, std::span<RayHit> hits) const {
    const float radius_mm = profile_.sample_radius_mm(u.x), angle_rad = 2 * kPi * u.y;
    const float half_mm =
        std::sqrt(std::max(0.0f, profile_.max_mm() * profile_.max_mm() - radius_mm * radius_mm));
    const Vec3 middle_mm =
        point.p_mm + disk.to_world({radius_mm * std::cos(angle_rad), radius_mm * std::sin(angle_rad), 0});
    return hits.first(rays_.all_hits(
        RaySet::skin,
        {.origin_mm = middle_mm + disk.normal * half_mm, .direction = -disk.normal, .max_mm = 2 * half_mm},
        hits));
}

void SurfaceIntegrator::probe(const DiffusePoint& point, const Probe& of, Sums& sums) const {
    HitBuffer<kMostHits> buffer;
    Pcg32 chance(of.seed, of.index);
    const Vec2 polar = OwenSequence(of.seed, of.index).next_2d();
    for (const RayHit& hit : probe_hits(point, of.disk, polar, buffer.hits())) {
        SurfaceAttributes surface = rays_.surface_at(hit);
        surface.footprint = point.footprint;
        const Vec3 offset_mm = surface.p_world_mm - point.p_mm;
        const float density = probe_density(of.disks, offset_mm, hit.n_face);
        if (density <= 0) continue;
        // First by the straight distance, which is at most the way through flesh and needs no rays.
        const float straight_weight = most(profile_.reflectance(length(offset_mm))) / density;
        const float survival = std::min(1.0f, straight_weight / kFullWeight);
        if (survival <= 0 || chance.next_1d() >= survival) continue;
        const float way_mm = way_through_flesh_mm(rays_, {point.p_mm, point.n_face},
                                                  {surface.p_world_mm, hit.n_face}, profile_.max_mm());
        if (way_mm > profile_.max_mm()) continue;
        const Vec3 weight = profile_.reflectance(way_mm) * (1 / (density * survival));
        const Receiver receiver = lighting_.skin_receiver(surface, hit);
        sums.irradiance += weight * (lighting_.irradiance(receiver, of.light) - of.own_irradiance);
        sums.reflectance += weight;
    }
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
        sum += lighting.irradiance(receiver, lighting_random(seed, first + uint32_t(i)));
    return sum * (1 / float(count));
}

SurfaceIntegrator::Result SurfaceIntegrator::estimate(const DiffusePoint& point, const Receiver& receiver,
                                                      uint32_t seed) const {
    const Disks disks = disks_around(point.n_geometry);
    const bool subtracts = settings_.normalisation == Normalisation::by_area && !lighting_.is_exact();
    Sums half[2];
    Vec3 own;
    // Each half is a run of every disk's sequence, as evenly spread as the whole. Every second probe is not:
    // as their order is shuffled, it is a random half, whose bias is more than twice that of the whole.
    uint32_t number = 0;
    for (uint32_t h = 0; h < 2; ++h)
        for (uint32_t d = 0; d < disks.size(); ++d)
            for (uint32_t i = 0; i < disks[d].probes; ++i) {
                Probe one{disks, disks[d].frame, hash_u32(seed, 2 + d), h * disks[d].probes + i,
                          lighting_random(seed, number++)};
                if (subtracts) own += one.own_irradiance = lighting_.irradiance(receiver, one.light);
                probe(point, one, half[h]);
            }
    const float share = 1 / float(settings_.probes);
    const Sums all{half[0].irradiance + half[1].irradiance, half[0].reflectance + half[1].reflectance};
    if (settings_.normalisation == Normalisation::none) return {all.irradiance * share, std::nullopt};
    const Vec3 a = quotient(half[0].irradiance, half[0].reflectance);
    const Vec3 b = quotient(half[1].irradiance, half[1].reflectance);
    const Vec3 m = quotient(all.irradiance, all.reflectance), wa = half[0].reflectance,
               wb = half[1].reflectance;
    const Vec3 spread = {jackknife(m.x, a.x, b.x, wa.x, wb.x), jackknife(m.y, a.y, b.y, wa.y, wb.y),
                         jackknife(m.z, a.z, b.z, wa.z, wb.z)};
    if (!subtracts) return {spread, std::nullopt};
    own = own * share;
    return {own + spread, own};
}

Estimate estimate_exitance(const SurfaceIntegrator& integrator, const DiffusePoint& point,
                           const Receiver& receiver, int estimates, uint32_t seed) {
    std::vector<Vec3> values(static_cast<size_t>(estimates));
    parallel_for(values.size(), 4, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            values[i] = integrator.exitance(point, receiver, hash_u32(seed, uint32_t(i)));
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
