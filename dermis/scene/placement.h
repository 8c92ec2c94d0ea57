#pragma once
// Light and camera for objects that come without.

#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// The largest index of refraction of skin that a scene takes.
inline constexpr float kMostSkinIor = 2;

/// Copies ior, roughness and specular into a material of skin.
void apply_skin(const Skin& skin, Material& material);

/// Values of a MaterialX profile that differ from the skin's: "skin.mtlx: specular_roughness
/// 0.3, skin.roughness is 0.45"; empty where both agree, or where the profile is another file.
[[nodiscard]] std::string surface_difference(const Skin& skin);
/// The skin with roughness and ior of its MaterialX profile where it has the defaults.
[[nodiscard]] Skin with_surface_of_profile(Skin skin);

/// Lights, environment, camera: a warm key from the upper left and the built-in studio, framing the objects.
/// Fills the bounds.
void place_in_studio(Scene& scene);

/// Its lights and environment alone.
void light_in_studio(Scene& scene);

/// The smallest sphere around the box of all positions, into the scene's bounds.
void compute_bounds(Scene& scene);

}  // namespace dermis::inline scene
