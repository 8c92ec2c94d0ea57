#pragma once
// Colour of skin whose blood follows the tension of its mesh (mesh/tension.h): stretched skin pales,
// compressed skin reddens.

#include <optional>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// The pigment model's albedo with blood * exp(-skin.blood_by_tension * tension), over its albedo with the
/// skin's mean blood. At 1 the amount of blood below a piece of skin stays when its area changes.
class BloodTint {
  public:
    /// Nothing where skin.blood_by_tension is 0. Errors: a profile that is not of pigments
    /// (optics/tissue/skin_model.h).
    [[nodiscard]] static Result<std::optional<BloodTint>> of(const Skin& skin);

    /// Interpolated between samples: within 0.003 of the model (docs/figures.md#tension).
    [[nodiscard]] Vec3 at(float tension) const;

  private:
    std::vector<Vec3> samples_;  // evenly over the tensions that there are
};

/// The colours of the vertices without the tint of their tensions.
[[nodiscard]] std::vector<Vec4> untinted_colors(const SceneObject& object, const BloodTint& tint);

/// Colours of the vertices of skin for their tensions. `untinted`: of untinted_colors(); empty: white.
void tint_by_tension(SceneObject& object, const BloodTint& tint, std::span<const Vec4> untinted);

/// Tints all skin of a scene whose pigments are known, once. Errors: those of BloodTint::of().
[[nodiscard]] Result<void> apply_blood_by_tension(Scene& scene);

}  // namespace dermis::inline scene
