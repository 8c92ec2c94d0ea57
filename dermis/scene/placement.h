#pragma once
// Light and camera for objects that come without.

#include "dermis/scene/scene.h"

namespace dermis {

/// Copies ior, roughness and specular into a material of skin.
void apply_skin(const Skin& skin, Material& material);

/// Lights, environment, camera: a warm key from the upper left and the built-in studio, framing the objects.
/// Fills the bounds.
void place_in_studio(Scene& scene);

/// Its lights and environment alone.
void light_in_studio(Scene& scene);

/// The smallest sphere around the box of all positions, into the scene's bounds.
void compute_bounds(Scene& scene);

}  // namespace dermis
