#pragma once
// Meshes of the unit scenes, each as one object of the scene. Lengths in mm.

#include "dermis/scene/scene.h"

namespace dermis::unit {

/// How far the planes and reliefs go on beyond the middle: seven standard deviations of skin's widest
/// Gaussian.
inline constexpr float kReachMm = 20;

/// Skin of the colour that the spheres have.
[[nodiscard]] SceneObject skin_object(std::string name, Mesh mesh);

/// The plane z = 0 between two x, facing +z. Its UVs are those of the whole plane.
[[nodiscard]] Mesh plane_between(float from_mm, float to_mm);

/// The same in two materials: light above y = 0, dark below.
[[nodiscard]] SceneObject two_albedos();

/// What is not skin and reflects nothing.
[[nodiscard]] SceneObject black_object(std::string name, Mesh mesh);

/// z = (x^2 - y^2) / (2 radius), whose mean curvature is 0 in the middle.
[[nodiscard]] Mesh saddle(float radius_mm);

/// z = slope * wavelength / (2 pi) * sin(2 pi x / wavelength). Its curvature is averaged, as that of any mesh
/// is.
[[nodiscard]] Mesh relief(float wavelength_mm, float slope);

/// A board that keeps a light from the right or left off x < 0 of the plane z = 0.
[[nodiscard]] SceneObject shading_board(Vec3 to_light);

}  // namespace dermis::unit
