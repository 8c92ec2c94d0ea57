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
// disk around x, a segment through it finds the surface; disks of three axes are combined by their densities.
// Both integrals use the same probes, so an even irradiance has no noise; the jackknife (Quenouille 1956)
// removes most of the quotient's bias.
//
// Where E is an estimate, each probe subtracts E(x), estimated with the same random numbers u_i as its E(y),
// and the mean of all E(x) is added (a control variate; Glasserman 2003, section 4.1):
//
//     M(x) = mean of E(x, u_i) + sum w_i (E(y_i, u_i) - E(x, u_i)) / sum w_i
//
// The picture without scattering is that mean by the same numbers: its noise cancels in the effect, and the
// noise of the penumbra mostly does where y is near x.

#include <array>
#include <optional>
#include <span>

#include "dermis/rays/sampling.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/profile_sampler.h"

namespace dermis::inline reference {

enum class Normalisation { by_area, none };

/// One of each half along each of the three axes.
inline constexpr int kLeastProbes = 6;

struct SurfaceIntegratorSettings {
    int probes = 16;  ///< a visible point, kLeastProbes..65536, even
    Normalisation normalisation = Normalisation::by_area;
};

/// A visible point of skin.
struct DiffusePoint {
    Vec3 p_mm;
    Vec3 n_geometry;  ///< interpolated
    Vec3 n_face;
    UvFootprint footprint = {};  ///< of the pixel that sees it: the maps around it are read as smoothly
};

/// Everything given must outlive it. Safe from any thread.
class SurfaceIntegrator {
  public:
    SurfaceIntegrator(const RayScene& rays, const Lighting& lighting, ProfileSampler profile,
                      const SurfaceIntegratorSettings& settings)
        : rays_(rays), lighting_(lighting), profile_(std::move(profile)), settings_(settings) {}

    struct Result {
        Vec3 exitance;            ///< over albedo, linear
        std::optional<Vec3> own;  ///< mean of E(x, u_i), where it was subtracted
    };
    /// By one set of probes. Estimates with different seeds are independent. `receiver` is the point's; it is
    /// read only where the lighting is not exact.
    [[nodiscard]] Result estimate(const DiffusePoint& point, const Receiver& receiver, uint32_t seed) const;
    [[nodiscard]] Vec3 exitance(const DiffusePoint& point, const Receiver& receiver, uint32_t seed) const {
        return estimate(point, receiver, seed).exitance;
    }

  private:
    struct Sums {
        Vec3 irradiance, reflectance;
    };
    /// Probes run along the frame's normal; every half has this many of them.
    struct Disk {
        LocalFrame frame;
        uint32_t probes = 0;
    };
    using Disks = std::array<Disk, 3>;
    [[nodiscard]] Disks disks_around(Vec3 normal) const;
    struct Probe {
        const Disks& disks;
        const LocalFrame& disk;
        uint32_t seed, index;
        LightingRandom light;
        Vec3 own_irradiance = {};  ///< of the visible point, subtracted from what the probe finds
    };
    void probe(const DiffusePoint& point, const Probe& of, Sums& sums) const;
    [[nodiscard]] std::span<const RayHit> probe_hits(const DiffusePoint& point, const LocalFrame& disk,
                                                     Vec2 u, std::span<RayHit> hits) const;
    [[nodiscard]] float probe_density(const Disks& disks, Vec3 offset_mm, Vec3 n_face) const;

    const RayScene& rays_;
    const Lighting& lighting_;
    ProfileSampler profile_;
    SurfaceIntegratorSettings settings_;
};

/// Numbers `index` of the light at a sample's point. The picture without scattering takes the same.
[[nodiscard]] LightingRandom lighting_random(uint32_t seed, uint32_t index);

/// The irradiance of a receiver by numbers first .. first + count - 1; from 0 on, the same as of an exitance
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
