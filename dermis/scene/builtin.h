#pragma once
// Scenes that need no file: what "builtin:NAME" and a bare mesh are placed in.

#include <string>
#include <string_view>
#include <vector>

#include "dermis/bust/params.h"
#include "dermis/scene/scene.h"

namespace dermis {

/// Written before the name of a mesh that needs no file.
inline constexpr std::string_view kBuiltinPrefix = "builtin:";

/// Radii of the built-in spheres, left to right.
inline constexpr float kSphereRadiiMm[4] = {2, 4, 8, 16};

[[nodiscard]] std::vector<std::string> builtin_mesh_names();

/// The objects of "builtin:NAME"; `bust` are the parameters of that one. Errors: an unknown name, a parameter
/// out of range.
[[nodiscard]] Result<std::vector<SceneObject>> make_builtin_objects(std::string_view name,
                                                                    const BustParams& bust = {});

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
