#pragma once
// The diffuse transport as a surface integral: light enters at y, spreads by the diffusion profile, leaves at
// x.
//
//     M(x) = integral E(y) R(d(x, y)) dA_y / integral R(d(x, y)) dA_y
//
// over all skin. d is the way through flesh (way_through_flesh.h): straight through an ear, around a fold. E
// is the shadowed irradiance on the shading normal of y, normal map included. dA is the triangles' area.
//
// Estimated by probes (King, Kulla, Conty, Fajardo 2013, BSSRDF Importance Sampling): the profile draws a
// radius on a disk around x, a segment through it finds the surface; the disk's three axes are combined by
// their densities. Both integrals use the same probes, so an even irradiance has no noise; the jackknife
// (Quenouille 1956) removes most of the quotient's bias.

#include "dermis/rays/sampling.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/profile_sampler.h"

namespace dermis::inline reference {

enum class Normalisation { by_area, none };

struct SurfaceIntegratorSettings {
    int probes = 16;  ///< a visible point, 2..65536, even
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

    /// Radiant exitance over albedo, linear, by one set of probes. Estimates with different seeds are
    /// independent.
    [[nodiscard]] Vec3 exitance(const DiffusePoint& point, uint32_t seed) const;

  private:
    struct Sums {
        Vec3 irradiance, reflectance;
    };
    void probe(const DiffusePoint& point, const LocalFrame& frame, uint32_t seed, uint32_t index,
               Sums& sums) const;
    [[nodiscard]] float probe_density(const LocalFrame& frame, Vec3 offset_mm, Vec3 n_face) const;

    const RayScene& rays_;
    const Lighting& lighting_;
    ProfileSampler profile_;
    SurfaceIntegratorSettings settings_;
};

/// Mean of independent estimates with the standard error that they show.
struct Estimate {
    Vec3 mean, standard_error;
};
[[nodiscard]] Estimate estimate_exitance(const SurfaceIntegrator& integrator, const DiffusePoint& point,
                                         int estimates, uint32_t seed);

}  // namespace dermis::inline reference
