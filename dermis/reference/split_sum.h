#pragma once
// Reflections of the environment as the renderer approximates them (shaders/include/environment.glsl): a
// prefiltered cube times the split sum's second factor, dimmed by occlusion. With it a comparison does
// not contain the error of that approximation.

#include "dermis/base/result.h"
#include "dermis/scene/brdf_table.h"
#include "dermis/scene/environment.h"

namespace dermis::inline reference {

class SplitSumReflection {
  public:
    /// Nothing is reflected of an environment of kind none. Errors as prepare_environment().
    [[nodiscard]] static Result<SplitSumReflection> load(const Environment& environment);

    /// `roughness` is perceptual, F0 one number, all vectors unit and in world space.
    [[nodiscard]] Vec3 radiance(Vec3 n, Vec3 to_eye, float roughness, float f0, float occlusion) const;

  private:
    [[nodiscard]] Vec3 cube(Vec3 d, float level) const;
    [[nodiscard]] Vec3 cube_level(Vec3 d, int level) const;
    [[nodiscard]] Vec3 texel(int level, int face, int x, int y) const;

    EnvironmentLight light_;
    BrdfTable brdf_;
    std::vector<size_t> level_starts_;  // into the cube's halves
    float intensity_ = 0, yaw_rad_ = 0;
};

/// How much of a reflection's cone the occlusion leaves: Lagarde, de Rousiers 2014, "Moving Frostbite to
/// PBR".
[[nodiscard]] float specular_occlusion(float n_dot_v, float occlusion, float roughness);

}  // namespace dermis::inline reference
