#pragma once
// The diffuse transport as a surface integral: light enters at y, spreads by the diffusion profile, leaves at
// x.
//
//     M(x) = integral E(y) R(d(x, y)) dA_y / integral R(d(x, y)) dA_y
//
// over all skin. d is the way through flesh (way_through_flesh.h): straight through an ear, around a fold. E
// is the shadowed irradiance on the shading normal of y, normal map included. dA is the triangles' area.
//
// Estimated by probes (King, Kulla, Conty, Fajardo 2013, BSSRDF Importance Sampling): a radius is drawn on a
// disk around x, a segment through it finds the surface. The disk's axis is drawn too, mostly the normal; the
// densities of all three are weighed together.
//
// Each probe subtracts E(x), estimated with the same random numbers u_i as its E(y), and the mean of all E(x)
// is added (a control variate; Glasserman 2003, section 4.1):
//
//     M(x) = mean of E(x, u_i) + N / D,    N = mean of w_i (E(y_i, u_i) - E(x, u_i)),    D = mean of w_i
//
// The picture without scattering is that mean by the same numbers: its noise cancels in the effect, and the
// noise of the penumbra mostly does where y is near x.
//
// A quotient of a few probes has a bias. So 1/D is the first terms of its series around D', an estimate of D
// by other probes that is made once for a pixel:
//
//     N / D = N / D' (1 + X + X^2 + ...),    X = 1 - D / D'
//
// each product by independent probes, of three runs, so that its mean has no bias (U-statistics; Hoeffding
// 1948). Within a run they lie evenly. What is left out is X^3 of N / D: a thousandth where D' is wrong by a
// tenth. In D and D' each probe subtracts what it would find on a plane, whose sum is known: on even skin
// they have no noise.

#include <array>
#include <span>

#include "dermis/rays/sampling.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/profile_sampler.h"

namespace dermis::inline reference {

enum class Normalisation { by_area, none };

/// Independent probes for the three factors of the products.
inline constexpr int kRuns = 3;

struct SurfaceIntegratorSettings {
    int probes_of_run = 1;  ///< a visible point; 1 or more
    Normalisation normalisation = Normalisation::by_area;
};

/// A visible point of skin.
struct DiffusePoint {
    Vec3 p_mm;
    Vec3 n_geometry;  ///< interpolated
    Vec3 n_face;
    UvFootprint footprint = {};  ///< of the pixel that sees it: the maps around it are read as smoothly
};

/// Samples with different seeds are independent; those of one seed lie evenly together.
struct SampleRandom {
    uint32_t seed, index;
    uint32_t first_light;  ///< of the numbers of the lights that it takes
};

/// Everything given must outlive it. Safe from any thread.
class SurfaceIntegrator {
  public:
    SurfaceIntegrator(const RayScene& rays, const Lighting& lighting, ProfileSampler profile,
                      const SurfaceIntegratorSettings& settings)
        : rays_(rays), lighting_(lighting), profile_(std::move(profile)), settings_(settings) {}

    /// Over albedo, linear.
    struct Result {
        Vec3 own;        ///< the light at the point itself: mean of E(x, u_i)
        Vec3 scattered;  ///< what scattering adds to it
        [[nodiscard]] Vec3 exitance() const { return own + scattered; }
    };
    /// By one set of probes. `receiver` is the point's; `reflectance` is that around it, of other seeds.
    [[nodiscard]] Result estimate(const DiffusePoint& point, const Receiver& receiver, Vec3 reflectance,
                                  SampleRandom random) const;

    /// An estimate of the integral of R dA around the point, each channel at least half of a plane's:
    /// where it is less, the effect is too small. It needs no light.
    [[nodiscard]] Vec3 reflectance_around(const DiffusePoint& point, int probes, uint32_t seed) const;

  private:
    /// The axes of the disks, the normal first.
    using Axes = std::array<LocalFrame, 3>;
    /// Those of one seed lie evenly; those of different seeds are independent.
    struct Probe {
        const Axes& axes;
        uint32_t seed, index;
    };
    /// Calls found(weight, surface, hit) for each skin that it meets. Returns what to add to the sum of its
    /// weights: 0 in the mean, and on a plane the sum is then the profile's total, without noise.
    template <class Found>
    Vec3 probe(const DiffusePoint& point, const Probe& of, const Found& found) const;
    [[nodiscard]] std::span<const RayHit> probe_hits(const DiffusePoint& point, const LocalFrame& disk,
                                                     Vec2 radius_mm_and_angle_rad,
                                                     std::span<RayHit> hits) const;
    [[nodiscard]] float probe_density(const Axes& axes, Vec3 offset_mm, Vec3 n_face) const;

    const RayScene& rays_;
    const Lighting& lighting_;
    ProfileSampler profile_;
    SurfaceIntegratorSettings settings_;
};

/// Numbers `index` of the light at a sample's point. The picture without scattering takes the same.
[[nodiscard]] LightingRandom lighting_random(uint32_t seed, uint32_t index);

/// The irradiance of a receiver by numbers first .. first + count - 1; from 0 on, the same as Result::own
/// by `count` probes.
[[nodiscard]] Vec3 mean_irradiance(const Lighting& lighting, const Receiver& receiver, uint32_t seed,
                                   int count, uint32_t first = 0);

/// Mean of independent estimates with the standard error that they show.
struct Estimate {
    Vec3 mean, standard_error;
};
[[nodiscard]] Estimate estimate_exitance(const SurfaceIntegrator& integrator, const DiffusePoint& point,
                                         const Receiver& receiver, int estimates, uint32_t seed);

}  // namespace dermis::inline reference
