#pragma once
// Random walks inside the scene's skin: what scattering adds to the light that a visible point would return
// without it.
//
//     M(x) / A = E(x) + mean over walks of (T E(y) - T' E(x)) / A
//
// T, y: throughput and end of a walk in the skin; T': throughput of the same walk, by the same random
// numbers, in the half-space behind the tangent plane, whose mean is the albedo A. Both walks are one until
// one of them leaves, so that most of the noise of absorption cancels (a control variate; Glasserman 2003,
// section 4.1). Normalisation::none is the mean of T E(y).

#include "dermis/rays/flesh_boundary.h"
#include "dermis/rays/guided_walk.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/surface_integrator.h"

namespace dermis::inline reference {

struct WalkIntegratorSettings {
    int walks = 32;  ///< a visible point, 1..65536
    Vec3 albedo;     ///< of the half-space under diffuse light, above 0; by_area
    Normalisation normalisation = Normalisation::by_area;
};

/// Lighting's entry_eta must be the medium's. The rays were built with find_flesh(), which closes the skin.
/// Safe from any thread.
class WalkIntegrator {
  public:
    WalkIntegrator(const RayScene& rays, const Lighting& lighting, const ScatteringMedium& medium,
                   const WalkIntegratorSettings& settings)
        : rays_(rays),
          lighting_(lighting),
          medium_(walk_medium(medium)),
          guide_(walk_guide(medium)),
          settings_(settings) {}

    struct Result {
        Vec3 exitance;
        int lost = 0;  ///< walks that found no way out
    };
    /// `receiver`: of the point; `irradiance`: its E, which may be an estimate by other random numbers.
    [[nodiscard]] Result exitance(const DiffusePoint& point, const Receiver& receiver, Vec3 irradiance,
                                  uint32_t seed) const;

  private:
    struct Effect {
        Vec3 sum;
        int lost = 0;
    };
    [[nodiscard]] Effect effect(const DiffusePoint& point, const Receiver& receiver, uint32_t seed) const;
    [[nodiscard]] Vec3 entering(const FleshBoundary& boundary, const DiffusePoint& point,
                                const LightingRandom& uniform) const;

    const RayScene& rays_;
    const Lighting& lighting_;
    WalkMedium medium_;
    WalkGuide guide_;
    WalkIntegratorSettings settings_;
};

}  // namespace dermis::inline reference
