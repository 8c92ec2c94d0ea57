#pragma once
// The head of a scene for an engine's package: meshes, maps, light and camera as files.
//
//     Result<Head> head = make_head(input);   // input.scene: after complete_scene()
//     make_package("three", {.profile = ..., .head = head->files});
//
// scene.json   camera, lights, environment, materials, and which map is what
// object_N.glb one for each mesh, in metres, with the material's maps embedded. Vertices have more texture
//              coordinates:
//                TEXCOORD_1  the skin's atlas
//                TEXCOORD_2  the mean curvature, half the difference between those along the two tangents
//                TEXCOORD_3  the mixed curvature, the occlusion of red scattered by the profile
//                TEXCOORD_4  that of green and blue
//                TEXCOORD_5  the occlusion as it is, the number of the vertex
//              Curvatures are in 1/mm in the frame of vertex_tangent() (shaders/include/skin/curvature.glsl).
//              A mesh that moves has its nodes, skins, morph targets and clips, in the scene's pose, and
//                TEXCOORD_6, TEXCOORD_7  the quaternion x y z w of the frame (tangent, normal x tangent,
//                                        normal) in which the scene's pose was baked
//              by which shaders turn what was baked to the frame of the pose that they draw
// N_curvature.png  of object N, where morph targets change the mean curvature: target_curvature.h.
//              curvature_of_targets of the object in scene.json names the targets in their order, and has the
//              rows of each and the largest change in 1/mm, which is kCurvatureSteps steps
// normals_red.png, normals_green.png, normals_spread.png
//              baked normals (shaders/include/skin/baked_normals.glsl) over the atlas. Red has 16 bits: the
//              high bytes above the low ones, in a picture of twice the height
// thickness.png over the atlas: kThicknessMaxMm for a value of 1
// N_M_normal.png an object-space normal map, which glTF cannot hold
// N_M_albedo.png, N_M_normal.png, N_M_surface.png
//              with HeadFormat::map_files, of the material M: surface has occlusion, roughness, factor on the
//              reflectance; red's baked normals are normals_red.exr then, in halves
// environment.hdr latitude-longitude, linear
//
// With ambient_probe, environment.ambient_probe of scene.json has 27 numbers: nine coefficients of Unity's
// SphericalHarmonicsL2, of each red, green and blue, of the irradiance over pi in a world whose x is
// mirrored.
//
// With reflected_shares, reflected_shares.exr has what a lobe reflects of light from all around, with
// reflections, reflections.exr what lobes see of the environment (head_maps.h).
//
// With still_maps, the meshes have none of the numbers above from TEXCOORD_2 on: vertex_maps of scene.json
// names the maps that have them (head_maps.h), and a mesh stands still. A light has the map of its shadow,
// and environment.ambient_terms has nine colours.

#include <array>
#include <string>
#include <vector>

#include "dermis/engines/package.h"
#include "dermis/image/image.h"
#include "dermis/rays/diffused_normals.h"
#include "dermis/scene/scene.h"

namespace dermis::inline engines {

inline constexpr float kThicknessMaxMm = 20;

struct HeadInput {
    const Scene& scene;
    /// Of size 0: the head has none, and a material scatters by the curvature of the vertices.
    DiffusedNormals normals;
    Image thickness_mm;  ///< over the atlas, one channel; empty: no light comes through
    /// Weights of the vertices' three blurred occlusions, of each channel.
    std::array<Vec3, 3> occlusion_weights;
    int map_side = 4096;  ///< larger maps are made smaller
    HeadFormat format = {};
};

struct Head {
    std::vector<PackageFile> files;
    std::vector<std::string> warnings;
};

/// The same input gives the same bytes. Errors: no skin, a map that cannot be read.
[[nodiscard]] Result<Head> make_head(const HeadInput& input);

}  // namespace dermis::inline engines
