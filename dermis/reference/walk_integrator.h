#pragma once
// Random walks inside the scene's skin: the exitance of a visible point from the light that enters elsewhere.
//
//     M(x) = mean of T E(y) = A E(x) + mean of (T E(y) - T' E(x))
//
// T, y: throughput and end of a walk in the skin; T': throughput of the same walk, by the same random
// numbers, in the half-space behind the tangent plane, whose mean is the albedo A. Both walks are one until
// one of them leaves, so that most of the noise of absorption cancels in the second form (a control variate;
// Glasserman 2003, section 4.1). It pays where E(x) has little noise of its own.

#include "dermis/rays/flesh_boundary.h"
#include "dermis/rays/guided_walk.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/surface_integrator.h"

namespace dermis::inline reference {

struct WalkIntegratorSettings {
    int walks = 32;  ///< a visible point, 1..65536
    /// Divides the result: the half-space's albedo makes it a blur of the light.
    Vec3 normalisation = {1, 1, 1};
    bool subtracts_flat = false;  ///< the second form; `normalisation` is A
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
          guide_(settings.subtracts_flat ? walk_guide_of_pairs(medium) : walk_guide(medium)),
          settings_(settings) {}

    struct Result {
        Vec3 exitance;
        int lost = 0;  ///< walks that found no way out
    };
    /// subtracts_flat: `receiver` is the point's, `irradiance` its E(x), which may be an estimate by other
    /// random numbers.
    [[nodiscard]] Result exitance(const DiffusePoint& point, const Receiver& receiver, Vec3 irradiance,
                                  uint32_t seed) const;

  private:
    [[nodiscard]] WalkPair walk(const DiffusePoint& point, FleshBoundary& boundary, float lead,
                                Pcg32 random) const;
    [[nodiscard]] Vec3 entering(const FleshBoundary& boundary, const DiffusePoint& point,
                                const LightingChoice& light) const;

    const RayScene& rays_;
    const Lighting& lighting_;
    WalkMedium medium_;
    WalkGuide guide_;
    WalkIntegratorSettings settings_;
};

}  // namespace dermis::inline reference
