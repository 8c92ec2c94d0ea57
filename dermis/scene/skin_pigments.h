#pragma once
// Skin from its pigments: the constants of [skin], and maps.

#include <optional>

#include "dermis/base/result.h"
#include "dermis/optics/tissue/skin_model.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// The model of the skin's pigments; nothing where none is given. The others keep the model's defaults.
[[nodiscard]] std::optional<SkinModel> pigments_of(const Skin& skin);

/// Skin with pigments and the default profile gets the profile of the model.
[[nodiscard]] Skin with_profile_of_pigments(Skin skin);

/// Replaces the pigments by the tint that gives the scene's skin the mean colour of the model. Errors: no
/// skin, a tone beside pigments.
[[nodiscard]] Result<void> apply_pigments(Scene& scene);

/// Paints the colour of skin materials that have maps of melanin or blood; their mean pigments choose the
/// profile, where none is named. Removes the pigments of the scene's skin then. A subject's own maps act only
/// where the skin scales its pigments or moves its blood. Takes half a second, and half a microsecond for
/// each texel. Errors: unreadable maps, maps of different sizes.
[[nodiscard]] Result<void> apply_pigment_maps(Scene& scene);

}  // namespace dermis::inline scene
