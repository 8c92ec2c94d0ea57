#pragma once
// One atlas for all skin of a scene: where light maps, baked normals and other maps that Dermis makes itself
// have their texels. mesh/atlas_layout.h describes the layout.

#include <string>
#include <vector>

#include "dermis/mesh/atlas_layout.h"
#include "dermis/mesh/uv_seams.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// A layout, and the hash of what it was made of.
struct SkinAtlas {
    std::string key;
    AtlasLayout layout;
};

/// Fills Mesh::atlas_uvs of objects with skin where the UVs of the file are missing, share texels or leave
/// 0..1; else leaves it empty. Vertices between layers are split; all attributes stay. Call it again after a
/// change of classes. The layout is that of the rest shape, so that every pose of a mesh has the same atlas;
/// Scene::skin_atlas keeps it for the next call.
void lay_out_skin_atlas(Scene& scene);

/// Positions, triangles and materials of a mesh with atlas_uvs_of() as its UVs, for functions that measure a
/// UV layout.
[[nodiscard]] Mesh over_atlas(const Mesh& mesh);

/// All skin of the scene as one mesh with both sets of UVs, its materials without maps: for tools that read
/// maps over the atlas. Without skin it has no triangles.
[[nodiscard]] Mesh skin_with_atlas(const Scene& scene);

/// The triangles of skin, one part for each object that has skin with UVs. `meshes` are what the parts point
/// to.
struct SkinParts {
    std::vector<Mesh> meshes;
    std::vector<AtlasPart> parts;
};
[[nodiscard]] SkinParts skin_over_atlas(const Scene& scene);

}  // namespace dermis::inline scene
