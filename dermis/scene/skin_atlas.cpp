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

// Appends the skin of an object; vertices of other materials are left out.
void append_skin(const SceneObject& object, Mesh& all) {
    const Mesh& mesh = object.mesh;
    const std::vector<Vec2>& atlas = atlas_uvs_of(mesh);
    std::vector<uint32_t> moved(mesh.positions_mm.size(), ~0u);
    for (const Submesh& submesh : mesh.submeshes) {
        if (object.classes[submesh.material] != MaterialClass::skin) continue;
        const Material& material = mesh.materials[submesh.material];
        all.submeshes.push_back({.name = submesh.name,
                                 .first_index = uint32_t(all.indices.size()),
                                 .index_count = submesh.index_count,
                                 .material = uint32_t(all.materials.size())});
        Material plain;
        plain.name = material.name;
        plain.base_color_linear = material.base_color_linear;
        all.materials.push_back(std::move(plain));
        for (uint32_t i = submesh.first_index; i < submesh.first_index + submesh.index_count; ++i) {
            const uint32_t v = mesh.indices[i];
            if (moved[v] == ~0u) {
                moved[v] = uint32_t(all.positions_mm.size());
                all.positions_mm.push_back(mesh.positions_mm[v]);
                all.normals.push_back(mesh.normals.empty() ? Vec3{0, 0, 1} : mesh.normals[v]);
                all.uvs.push_back(mesh.uvs.empty() ? Vec2{} : mesh.uvs[v]);
                all.atlas_uvs.push_back(atlas.empty() ? Vec2{} : atlas[v]);
            }
            all.indices.push_back(moved[v]);
        }
    }
}

}  // namespace

Mesh skin_with_atlas(const Scene& scene) {
    Mesh all;
    for (const SceneObject& object : scene.objects) append_skin(object, all);
    return all;
}

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
    std::vector<SceneObject>& laid_out = scene.rest_objects.empty() ? scene.objects : scene.rest_objects;
    for (SceneObject& object : scene.objects) object.mesh.atlas_uvs.clear();
    std::vector<AtlasPart> parts;
    std::vector<size_t> numbers;
    for (size_t i = 0; i < laid_out.size(); ++i) {
        laid_out[i].mesh.atlas_uvs.clear();
        laid_out[i].classes = scene.objects[i].classes;
        AtlasPart part{&laid_out[i].mesh, skin_triangles(laid_out[i])};
        if (part.triangles.empty()) continue;
        parts.push_back(std::move(part));
        numbers.push_back(i);
    }
    const AtlasLayout layout = lay_out_atlas(parts);
    if (layout.is_as_it_was) return;
    for (size_t i = 0; i < parts.size(); ++i) {
        apply(laid_out[numbers[i]].mesh, parts[i], layout.parts[i]);
        if (!scene.rest_objects.empty()) apply(scene.objects[numbers[i]].mesh, parts[i], layout.parts[i]);
    }
}

}  // namespace dermis::inline scene
