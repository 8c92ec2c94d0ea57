#pragma once
// Skin of another tone on the same head.

#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// The mean base colour of the scene's skin, linear: the maps are looked up at every vertex, so that what
/// lies outside of the islands does not count. 50 ms for a 2048 x 2048 JPEG. Errors: no skin, an unreadable
/// map.
[[nodiscard]] Result<Vec3> mean_skin_albedo(const Scene& scene);

/// Skin::albedo_tint_linear with which the mean becomes `albedo_linear`: relative differences (lips,
/// freckles) stay.
[[nodiscard]] Vec3 tint_towards(Vec3 albedo_linear, Vec3 mean_linear);

/// The skin's tint beside that of its tone or pigments: a file that states both has this albedo_tint.
[[nodiscard]] Vec3 stated_tint(const Skin& skin);

/// "openpbr_skin_3", the profile of a tone, 1 to 6.
[[nodiscard]] std::string tone_profile(int tone);

/// Skin with a tone and the default profile gets the profile of the tone.
[[nodiscard]] Skin with_profile_of_tone(Skin skin);

/// Colour of skin whose mesh states none: of the tone, else of the profile where its albedo is that of skin,
/// else a light one.
[[nodiscard]] Vec3 usual_skin_albedo(const Skin& skin);

/// Replaces Skin::tone by the tint that gives the scene's skin the mean colour of the tone.
[[nodiscard]] Result<void> apply_tone(Scene& scene);

/// A profile that states another surface, that reflects more light than arrives, or that is of a much lighter
/// or darker skin than the scene's; a line each. A profile that cannot be read is reported elsewhere.
[[nodiscard]] std::vector<std::string> skin_warnings(const Scene& scene);

}  // namespace dermis::inline scene
