#pragma once
// Pictures of a head: reflections, and what a head that stands still has, for HeadFormat::still_maps.
// Internal to dermis/engines.

#include <nlohmann/json.hpp>
#include <vector>

#include "dermis/engines/package.h"
#include "dermis/image/image.h"
#include "dermis/scene/environment.h"
#include "dermis/scene/scene.h"

namespace dermis::inline engines {

/// A file of this name: .png or .exr.
[[nodiscard]] Result<void> add_picture(const std::string& name, const Image& image,
                                       std::vector<PackageFile>& files);

/// Numbers of the vertices of a mesh as they are in TEXCOORD_2 to TEXCOORD_5 (head.h): four pairs.
using VertexNumbers = std::vector<std::vector<Vec2>>;

/// The numbers as vertex_bends.exr (red, green, blue: the curvature in 1/mm; alpha: the occlusion) and
/// vertex_occlusion.png (that scattered by the profile) over the atlas, one VertexNumbers an object. Returns
/// their names.
[[nodiscard]] Result<nlohmann::json> add_vertex_maps(const Scene& scene,
                                                     std::span<const VertexNumbers> numbers,
                                                     std::vector<PackageFile>& files);

/// False for a point or spot light in or close to the sphere around the scene.
[[nodiscard]] bool can_have_shadow_map(const Scene& scene, const Light& light);

/// What a light sees, as a half-float EXR of this name: in red, how far towards the light from center_mm its
/// first surface is, in mm. Rows begin at -radius_mm along y, columns at -radius_mm along x; both axes are in
/// what is returned, with to_light. Of a point or spot light these are lengths at center_mm, at 1 /
/// inverse_distance_per_mm mm from the light; a place that is d mm nearer is enlarged by 1 / (1 - d
/// inverse_distance_per_mm). Only for a light that can_have_shadow_map().
[[nodiscard]] Result<nlohmann::json> add_shadow_map(const Scene& scene, const Light& light,
                                                    const std::string& name, std::vector<PackageFile>& files);

/// Coefficients of irradiance over pi by direction n in the world, of 1, y, z, x, xy, yz, 3 z^2 - 1, xz,
/// x^2 - y^2: nine colours, intensity included.
[[nodiscard]] nlohmann::json ambient_terms(const EnvironmentLight& light, const Environment& environment);

inline constexpr std::string_view kReflectedShares = "reflected_shares.exr", kReflections = "reflections.exr";

/// kReflectedShares: of light from all around, what a GGX lobe reflects, f0 times red plus green; n.v from
/// left to right, roughness from top to bottom (scene/brdf_table.h).
[[nodiscard]] Result<void> add_reflected_shares(std::vector<PackageFile>& files);

/// kReflections: the environment of the world as GGX lobes of even roughnesses from 0 to 1 see it, in the
/// layout of engines/common/reflections.glsl; intensity included. Half a second. Returns its name and number
/// of levels.
[[nodiscard]] Result<nlohmann::json> add_reflections(const Environment& environment, const Image& panorama,
                                                     std::vector<PackageFile>& files);

/// The smallest and the largest corner of the mesh, in mm.
[[nodiscard]] nlohmann::json box_json(const Mesh& mesh);

}  // namespace dermis::inline engines
