#include "dermis/scene/skin_atlas.h"

#include <algorithm>

#include "dermis/mesh/atlas_layout.h"
#include "dermis/mesh/topology.h"

namespace dermis::inline scene {
namespace {

std::vector<uint32_t> skin_triangles(const SceneObject& object) {
    std::vector<uint32_t> triangles;
    for (const Submesh& submesh : object.mesh.submeshes)
        if (object.classes[submesh.material] == MaterialClass::skin)
            for (uint32_t i = 0; i < submesh.index_count / 3; ++i)
                triangles.push_back(submesh.first_index / 3 + i);
    return triangles;
}

void apply(Mesh& mesh, const AtlasPart& part, std::span<const AtlasLayout::Corners> corners) {
    std::vector<uint32_t> layer_of_corner(mesh.indices.size(), 0);
    for (size_t t = 0; t < corners.size(); ++t)
        std::fill_n(layer_of_corner.begin() + 3 * std::ptrdiff_t(part.triangles[t]), 3, corners[t].layer + 1);
    split_vertices(mesh, layer_of_corner);
    mesh.atlas_uvs.assign(mesh.positions_mm.size(), Vec2{});
    for (size_t t = 0; t < corners.size(); ++t)
        for (size_t k = 0; k < 3; ++k)
            mesh.atlas_uvs[mesh.indices[3 * size_t(part.triangles[t]) + k]] = corners[t].uvs[k];
}

}  // namespace

Mesh over_atlas(const Mesh& mesh) {
    Mesh copy;
    copy.positions_mm = mesh.positions_mm;
    copy.uvs = atlas_uvs_of(mesh);
    copy.indices = mesh.indices;
    copy.submeshes = mesh.submeshes;
    copy.materials = mesh.materials;
    return copy;
}

SkinParts skin_over_atlas(const Scene& scene) {
    SkinParts skin;
    skin.meshes.reserve(scene.objects.size());
    for (const SceneObject& object : scene.objects) {
        if (atlas_uvs_of(object.mesh).size() != object.mesh.positions_mm.size()) continue;
        std::vector<uint32_t> triangles = skin_triangles(object);
        if (triangles.empty()) continue;
        skin.meshes.push_back(over_atlas(object.mesh));
        skin.parts.push_back({&skin.meshes.back(), std::move(triangles)});
    }
    return skin;
}

void lay_out_skin_atlas(Scene& scene) {
    std::vector<AtlasPart> parts;
    std::vector<Mesh*> meshes;
    for (SceneObject& object : scene.objects) {
        object.mesh.atlas_uvs.clear();
        AtlasPart part{&object.mesh, skin_triangles(object)};
        if (part.triangles.empty()) continue;
        parts.push_back(std::move(part));
        meshes.push_back(&object.mesh);
    }
    const AtlasLayout layout = lay_out_atlas(parts);
    if (layout.is_as_it_was) return;
    for (size_t i = 0; i < parts.size(); ++i) apply(*meshes[i], parts[i], layout.parts[i]);
}

}  // namespace dermis::inline scene
