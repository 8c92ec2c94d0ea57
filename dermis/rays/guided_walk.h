#pragma once
// The random walk with less noise: steps are drawn towards the boundary by which the walk entered.
//
// In a half-space the light that will leave grows towards the boundary as exp(z / nu), nu the diffusion
// length in mean free paths. Collisions choose the cosine w to the outward normal with density 1 / (nu - w),
// free paths the extinction (1 - w / nu) sigma_t: Krivanek, d'Eon 2014, A Zero-variance-based Sampling Scheme
// for Monte Carlo Subsurface Scattering (Dwivedi 1982). Each step of a guided walk does so with a fixed
// chance, else it follows the medium. A part of the walks is plain. The channels lead the walks in turn, and
// a walk is weighted by the mean density of all channels, guided and plain (Wilkie et al. 2014; Veach 1997,
// balance heuristic). So no weight is larger than a plain walk's over kPlainWalks: in a ball, an ear or a
// wrinkle guided steps alone leave much light to a few walks. The mean is that of random_walk (tested).

#include "dermis/rays/random_walk.h"

namespace dermis::inline rays {

struct WalkGuide {
    Vec3 diffusion_length;  ///< nu of each channel, in mean free paths, > 1
    Vec3 log_ratio;         ///< log((nu + 1) / (nu - 1)): the integral of 1 / (nu - w)
    float chance = 0;       ///< of a step to be guided, below 1
};
[[nodiscard]] WalkGuide walk_guide(const ScatteringMedium& medium);

/// The largest root of 1 = alpha nu / 2 log((nu + 1) / (nu - 1)), the decay of light in an isotropic medium
/// of albedo alpha, 0..1; kept within 1.01..100, where the walk needs no exact one.
[[nodiscard]] double diffusion_length_in_paths(double albedo);

/// A step of the walk: where to, and whether its direction was free to choose (after a collision) or given.
struct GuidedStep {
    Vec3 direction;
    float distance_mm = 0;
    float phase = 0;  ///< phase function of the direction over 1 / 4 pi; 0 when it was given
};
/// `turned`: a collision turns the path now, else `direction` stays.
[[nodiscard]] GuidedStep sample_guided_step(const WalkMedium& medium, const WalkGuide& guide, int hero,
                                            Vec3 n_out, Vec3 direction, bool turned, Pcg32& random);

/// The part of the walks that is plain from beginning to end.
inline constexpr float kPlainWalks = 0.2f;

/// Throughput of a walk, and the relative densities with which each channel would have led it here by a
/// guided and by a plain walk; they sum to 1.
struct GuidedWeight {
    Vec3 throughput = {1, 1, 1};
    Vec3 led_by = Vec3{1, 1, 1} * ((1 - kPlainWalks) / 3);
    Vec3 plain_by = Vec3{1, 1, 1} * (kPlainWalks / 3);
};
/// After a step: the throughput times what the step carries over the density with which it is drawn.
/// `collides`: it ends in the medium, after `distance_mm`; else it reached the boundary there.
[[nodiscard]] GuidedWeight after_step(const WalkMedium& medium, const WalkGuide& guide,
                                      const GuidedWeight& weight, const GuidedStep& step, float cosine_out,
                                      float distance_mm, bool collides);

/// Collisions after which a walk is no longer guided: the weights of every guided step multiply, and those of
/// hundreds (a medium that hardly absorbs) would leave the light to a few rare paths.
inline constexpr int kGuidedCollisions = 64;

/// As random_walk; n_out: outward normal where the walk starts; hero: the channel that leads it, 0..2, each a
/// third of all walks.
template <class Boundary>
[[nodiscard]] WalkEnd guided_walk(const WalkMedium& medium, const WalkGuide& guide, Boundary&& boundary,
                                  Vec3 p_mm, Vec3 n_out, Vec3 direction, int hero, Pcg32& random) {
    WalkEnd path{.p_mm = p_mm, .direction = direction};
    GuidedWeight weight;
    const WalkEnd absorbed{};
    const bool plain = random.next_1d() < kPlainWalks;
    // `now` draws the steps, `other` is what a guided walk would draw.
    WalkGuide now = guide, other = guide;
    if (plain) now.chance = 0;
    bool turned = false;
    while (path.collisions < kMostCollisions) {
        const GuidedStep step = sample_guided_step(medium, now, hero, n_out, path.direction, turned, random);
        path.direction = step.direction;
        const std::optional<BoundaryHit> hit = boundary(path.p_mm, path.direction, step.distance_mm);
        if (hit && dot(hit->n_out, path.direction) <= 0) return {.lost = true};
        const float distance_mm = hit ? hit->distance_mm : step.distance_mm;
        weight = after_step(medium, other, weight, step, dot(path.direction, n_out), distance_mm,
                            !hit.has_value());
        path.p_mm += path.direction * distance_mm;
        turned = !hit.has_value();
        if (turned) {
            if (++path.collisions == kGuidedCollisions) now.chance = other.chance = 0;
            if (!survives_roulette(weight.throughput, random)) return absorbed;
            continue;
        }
        const auto reflected = reflected_at(*hit, path.direction, medium.eta, random);
        if (!reflected) {
            path.throughput = weight.throughput;
            return path;
        }
        path.direction = *reflected;
    }
    return absorbed;
}

/// As half_space_albedo under diffuse light, with a seventh to a half of the variance; walks: a multiple
/// of 3.
[[nodiscard]] HalfSpaceAlbedo guided_half_space_albedo(const ScatteringMedium& medium, int walks,
                                                       uint32_t seed);

}  // namespace dermis::inline rays
