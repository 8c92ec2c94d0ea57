#pragma once
// The random walk with less noise: steps are drawn towards the boundary by which the walk entered.
//
// In a half-space the light that will leave grows towards the boundary as exp(z / nu), nu the diffusion
// length in mean free paths. Collisions choose the cosine w to the outward normal with density 1 / (nu - w),
// free paths the extinction (1 - w / nu) sigma_t: Krivanek, d'Eon 2014, A Zero-variance-based Sampling Scheme
// for Monte Carlo Subsurface Scattering (Dwivedi 1982). Each step of a guided walk does so with a fixed
// chance, else it follows the medium. A part of the walks is plain. One channel leads a walk, and a walk is
// weighted by the mean density of all channels, guided and plain (Wilkie et al. 2014; Veach 1997, balance
// heuristic). So no weight is larger than that of a plain walk led by its channel, over kPlainWalks and the
// channel's chance to lead: in a ball, an ear or a wrinkle guided steps alone leave much light to a few
// walks. The mean is that of random_walk (tested).

#include "dermis/rays/random_walk.h"

namespace dermis::inline rays {

struct WalkGuide {
    Vec3 diffusion_length;  ///< nu of each channel, in mean free paths, > 1
    Vec3 log_ratio;         ///< log((nu + 1) / (nu - 1)): the integral of 1 / (nu - w)
    Vec3 leads;             ///< chance of each channel to lead a walk; they sum to 1
    float chance = 0;       ///< of a step to be guided, below 1
};
/// Every channel leads as often.
[[nodiscard]] WalkGuide walk_guide(const ScatteringMedium& medium);
/// For guided_walk_and_flat: the channel whose light spreads farthest leads most walks, in all but media that
/// hardly absorb. Longer walks, with a half to a third of the variance of the difference.
[[nodiscard]] WalkGuide walk_guide_of_pairs(const ScatteringMedium& medium);

/// The largest root of 1 = alpha nu / 2 log((nu + 1) / (nu - 1)), the decay of light in an isotropic medium
/// of albedo alpha, 0..1; kept within 1.01..100, where the walk needs no exact one.
[[nodiscard]] double diffusion_length_in_paths(double albedo);

/// The part of the walks that is plain from beginning to end.
inline constexpr float kPlainWalks = 0.2f;

/// A walk, step by step. Copies go on by the same random numbers. Medium and guide must outlive it.
class GuidedWalk {
  public:
    /// n_out: outward normal where the walk starts; lead: chooses the channel that leads it, in [0, 1), even
    /// over all walks.
    GuidedWalk(const WalkMedium& medium, const WalkGuide& guide, Vec3 p_mm, Vec3 n_out, Vec3 direction,
               float lead, Pcg32 random);

    /// Draws the next step: direction() and distance_mm() from p_mm().
    void draw();
    /// Takes it; `hit`: where it meets the boundary. False when the walk has ended.
    bool take(const std::optional<BoundaryHit>& hit);

    [[nodiscard]] Vec3 p_mm() const { return path_.p_mm; }
    [[nodiscard]] Vec3 direction() const { return path_.direction; }
    [[nodiscard]] float distance_mm() const { return distance_mm_; }
    /// Of a walk that has ended.
    [[nodiscard]] const WalkEnd& end() const { return path_; }

    /// Where the drawn step meets the boundary.
    template <class Boundary>
    [[nodiscard]] std::optional<BoundaryHit> meets(Boundary&& boundary) const {
        return boundary(path_.p_mm, path_.direction, distance_mm_);
    }
    /// To the end, from a step that is drawn and meets the boundary in `hit`.
    template <class Boundary>
    [[nodiscard]] WalkEnd finish(Boundary&& boundary, std::optional<BoundaryHit> hit) {
        while (take(hit)) {
            draw();
            hit = meets(boundary);
        }
        return path_;
    }

  private:
    void weigh(float distance_mm, bool collides);
    bool ends(const WalkEnd& with) {
        path_ = with;
        return false;
    }

    const WalkMedium& medium_;
    const WalkGuide& guide_;
    Pcg32 random_;
    Vec3 n_out_;
    int hero_;
    WalkEnd path_;
    /// The relative densities with which each channel would have led the walk here by guided and by plain
    /// steps; they sum to 1.
    Vec3 led_by_, plain_by_;
    float draw_chance_, guided_chance_;  ///< of a step of this walk, of a guided walk to be guided
    float distance_mm_ = 0;
    float phase_ = 0;  ///< phase function of the direction over 1 / 4 pi; 0 when the direction was given
    bool turned_ = false;
};

/// As random_walk.
template <class Boundary>
[[nodiscard]] WalkEnd guided_walk(const WalkMedium& medium, const WalkGuide& guide, Boundary&& boundary,
                                  Vec3 p_mm, Vec3 n_out, Vec3 direction, float lead, Pcg32 random) {
    GuidedWalk walk(medium, guide, p_mm, n_out, direction, lead, random);
    walk.draw();
    return walk.finish(boundary, walk.meets(boundary));
}

/// Two walks by the same random numbers: they are one until the first of them leaves. Their difference has
/// little of the noise of absorption.
struct WalkPair {
    WalkEnd end;
    WalkEnd flat;  ///< in the half-space behind the tangent plane of the start
};
template <class Boundary>
[[nodiscard]] WalkPair guided_walk_and_flat(const WalkMedium& medium, const WalkGuide& guide,
                                            Boundary&& boundary, Vec3 p_mm, Vec3 n_out, Vec3 direction,
                                            float lead, Pcg32 random) {
    const PlaneBoundary plane{p_mm, n_out};
    GuidedWalk walk(medium, guide, p_mm, n_out, direction, lead, random);
    for (;;) {
        walk.draw();
        const auto hit = walk.meets(boundary), flat_hit = walk.meets(plane);
        if (hit || flat_hit) {
            GuidedWalk flat = walk;
            return {walk.finish(boundary, hit), flat.finish(plane, flat_hit)};
        }
        if (!walk.take(std::nullopt)) return {walk.end(), walk.end()};
    }
}

/// As half_space_albedo under diffuse light, with a seventh to a half of the variance.
[[nodiscard]] HalfSpaceAlbedo guided_half_space_albedo(const ScatteringMedium& medium, int walks,
                                                       uint32_t seed);

}  // namespace dermis::inline rays
