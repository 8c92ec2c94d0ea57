#pragma once
// The environment for the reference: radiance from a direction, and directions drawn where it is
// bright.

#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/reference/guide_table.h"
#include "dermis/scene/environment.h"
#include "dermis/scene/scene.h"

namespace dermis::inline reference {

class EnvironmentSampler {
  public:
    /// Errors as load_panorama.
    [[nodiscard]] static Result<EnvironmentSampler> load(const Environment& environment);

    /// No light from anywhere.
    [[nodiscard]] bool dark() const { return cumulative_.empty(); }
    /// With the environment's turn and intensity.
    [[nodiscard]] Vec3 radiance(Vec3 d_world) const;
    /// The order-2 approximation that the renderer uses.
    [[nodiscard]] Vec3 harmonic_irradiance(Vec3 n_world) const;

    struct Sample {
        Vec3 direction_world;
        Vec2 place;         ///< of that direction, as place() has it
        float density = 0;  ///< per steradian
    };
    /// A texel by its share of the light, then evenly within it. Not when dark().
    [[nodiscard]] Sample sample(Vec2 u) const;
    /// A direction's place in the panorama, for both of what is there. Not when dark().
    [[nodiscard]] Vec2 place(Vec3 d_world) const;
    [[nodiscard]] Vec3 radiance_at(Vec2 place) const;
    [[nodiscard]] float density_at(Vec2 place) const;

  private:
    [[nodiscard]] Vec3 to_world(Vec3 d) const;

    Image panorama_;
    RadianceSh sh_{};
    std::vector<double> cumulative_;  // over texels, row by row; the last is 1
    GuideTable guide_;                // of cumulative_
    float intensity_ = 1;
    EnvironmentTurn turn_;
};

}  // namespace dermis::inline reference
