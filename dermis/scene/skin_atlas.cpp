#include "dermis/scene/skin_atlas.h"

#include <algorithm>

#include "dermis/base/hash.h"
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

void apply(SceneObject& object, std::span<const uint32_t> triangles,
           std::span<const AtlasLayout::Corners> corners) {
    Mesh& mesh = object.mesh;
    std::vector<uint32_t> layer_of_corner(mesh.indices.size(), 0);
    for (size_t t = 0; t < corners.size(); ++t)
        std::fill_n(layer_of_corner.begin() + 3 * std::ptrdiff_t(triangles[t]), 3, corners[t].layer + 1);
    const std::vector<uint32_t> from = split_vertices(mesh, layer_of_corner);
    for (auto& [target, changes] : object.blood_by_target)
        for (size_t v = changes.size(); v < from.size(); ++v) changes.push_back(changes[from[v]]);
    mesh.atlas_uvs.assign(mesh.positions_mm.size(), Vec2{});
    for (size_t t = 0; t < corners.size(); ++t)
        for (size_t k = 0; k < 3; ++k)
            mesh.atlas_uvs[mesh.indices[3 * size_t(triangles[t]) + k]] = corners[t].uvs[k];
}

// What a layout is made of: the triangles and UVs of the file, and the rest shape.
Mesh rest_shape(const Mesh& mesh) {
    return {.positions_mm = mesh.rest_positions_mm.empty() ? mesh.positions_mm : mesh.rest_positions_mm,
            .uvs = mesh.uvs,
            .indices = mesh.indices,
            .submeshes = mesh.submeshes};
}

// By corner, so that vertices that a layout has split do not count.
std::string atlas_key(std::span<const AtlasPart> parts) {
    Hasher hasher;
    for (const AtlasPart& part : parts) {
        std::vector<Vec3> positions_mm;
        std::vector<Vec2> uvs;
        for (const uint32_t index : part.mesh->indices) {
            positions_mm.push_back(part.mesh->positions_mm[index]);
            if (!part.mesh->uvs.empty()) uvs.push_back(part.mesh->uvs[index]);
        }
        hasher.add(positions_mm).add(uvs).add(part.triangles);
        for (const Submesh& submesh : part.mesh->submeshes)
            hasher.add(submesh.first_index).add(submesh.index_count).add(submesh.material);
    }
    return hasher.hex();
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
    std::vector<Mesh> shapes(scene.objects.size());
    std::vector<AtlasPart> parts;
    std::vector<size_t> numbers;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        scene.objects[i].mesh.atlas_uvs.clear();
        if (!scene.rest_objects.empty()) {
            scene.rest_objects[i].mesh.atlas_uvs.clear();
            scene.rest_objects[i].classes = scene.objects[i].classes;
        }
        std::vector<uint32_t> triangles = skin_triangles(scene.objects[i]);
        if (triangles.empty()) continue;
        shapes[i] = rest_shape(scene.objects[i].mesh);
        parts.push_back({&shapes[i], std::move(triangles)});
        numbers.push_back(i);
    }
    std::string key = atlas_key(parts);
    if (!scene.skin_atlas || scene.skin_atlas->key != key)
        scene.skin_atlas = std::make_shared<const SkinAtlas>(SkinAtlas{std::move(key), lay_out_atlas(parts)});
    const AtlasLayout& layout = scene.skin_atlas->layout;
    if (layout.is_as_it_was) return;
    for (size_t i = 0; i < parts.size(); ++i) {
        apply(scene.objects[numbers[i]], parts[i].triangles, layout.parts[i]);
        if (!scene.rest_objects.empty())
            apply(scene.rest_objects[numbers[i]], parts[i].triangles, layout.parts[i]);
    }
}

}  // namespace dermis::inline scene
