#pragma once
// The environment for the ground truth: radiance from a direction, and directions drawn where it is
// bright.

#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/scene/environment.h"
#include "dermis/scene/scene.h"

namespace dermis {

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
        float density = 0;  ///< per steradian
    };
    /// A texel by its share of the light, then evenly within it. Not when dark().
    [[nodiscard]] Sample sample(Vec2 u) const;
    [[nodiscard]] float density(Vec3 d_world) const;

  private:
    [[nodiscard]] Vec3 to_world(Vec3 d) const;

    Image panorama_;
    RadianceSh sh_{};
    std::vector<double> cumulative_;  // over texels, row by row; the last is 1
    float intensity_ = 1, yaw_rad_ = 0;
};

}  // namespace dermis
