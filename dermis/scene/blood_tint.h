#pragma once
// Colour of skin whose blood changes with the pose: by the tension of its mesh (mesh/tension.h), so that
// stretched skin pales and compressed skin reddens, and by maps of change that each belong to a morph target
// (after Jimenez et al. 2010, "A practical appearance model for dynamic facial color", who measure one map of
// haemoglobin per expression and blend them by the expressions' weights).

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// The pigment model's albedo with blood * exp(log_blood), over its albedo with the skin's mean blood.
class BloodTint {
  public:
    /// Nothing where the skin's blood does not move. Errors: a profile that is not of pigments
    /// (optics/tissue/skin_model.h).
    [[nodiscard]] static Result<std::optional<BloodTint>> of(const Skin& skin);

    /// Interpolated between samples: within 0.003 of the model (docs/figures.md#tension).
    [[nodiscard]] Vec3 at(float log_blood) const;

  private:
    std::vector<Vec3> samples_;  // evenly over what at() does not clamp
};

/// Samples the change of one morph target at the vertices of the scene's skin. `map`: a factor of the blood
/// for each texel, of its first channel: 4^(2 value - 1), so that 0.5 changes nothing, 1 is four times the
/// blood and 0 a quarter. At a weight w the logarithm is multiplied by w. Errors: no mesh has the target, a
/// map that cannot be read, no UVs.
[[nodiscard]] Result<void> add_blood_by_target(const std::string& target, const std::filesystem::path& map,
                                               Scene& scene);

/// The colours of the vertices without the tint of the object's pose.
[[nodiscard]] std::vector<Vec4> untinted_colors(const SceneObject& object, const Skin& skin,
                                                const BloodTint& tint);

/// Colours of the vertices of skin in the object's pose, for a factor of the blood of
/// exp(sum of the targets' logarithms - skin.blood_by_tension * tension): at blood_by_tension = 1 the amount
/// of blood below a piece of skin stays when its area changes. `untinted`: of untinted_colors(); empty:
/// white.
void tint_by_blood(SceneObject& object, const Skin& skin, const BloodTint& tint,
                   std::span<const Vec4> untinted);

/// Tints all skin of a scene whose pigments are known, once. Errors: those of BloodTint::of().
[[nodiscard]] Result<void> apply_moving_blood(Scene& scene);

}  // namespace dermis::inline scene
