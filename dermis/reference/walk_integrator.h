#pragma once
// Random walks inside the scene's skin: the exitance of a visible point from the light that enters elsewhere.

#include "dermis/rays/guided_walk.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/surface_integrator.h"

namespace dermis::inline reference {

struct WalkIntegratorSettings {
    int walks = 32;  ///< a visible point, 1..65536
    Vec3 normalisation = {1, 1,
                          1};  ///< divides the result: the half-space's albedo makes it a blur of the light
};

/// M(x) = mean over walks of throughput * E(y) / normalisation, E with Lighting's entry_eta, which must be
/// the medium's. The rays were built with find_flesh(), which closes the skin. Safe from any thread.
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
    [[nodiscard]] Result exitance(const DiffusePoint& point, uint32_t seed) const;

  private:
    const RayScene& rays_;
    const Lighting& lighting_;
    WalkMedium medium_;
    WalkGuide guide_;
    WalkIntegratorSettings settings_;
};

}  // namespace dermis::inline reference
