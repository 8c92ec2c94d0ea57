#pragma once
// The same surface with other UVs, as heads of other tools have them.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "dermis/mesh/topology.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/skin_atlas.h"
#include "support/built_in.h"

namespace dermis {

/// Moves the UVs of each triangle by a function of its group; vertices between groups are split.
inline void regroup_uvs(Mesh& mesh, const std::function<uint32_t(Vec3 middle_mm)>& group_of,
                        const std::function<Vec2(Vec2 uv, uint32_t group)>& moved) {
    std::vector<uint32_t> groups;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        Vec3 middle;
        for (size_t k = 0; k < 3; ++k) middle += mesh.positions_mm[mesh.indices[3 * t + k]] * (1.0f / 3);
        groups.insert(groups.end(), 3, group_of(middle));
    }
    split_vertices(mesh, groups);
    std::vector<uint32_t> of_vertex(mesh.positions_mm.size(), 0);
    for (size_t i = 0; i < mesh.indices.size(); ++i) of_vertex[mesh.indices[i]] = groups[i];
    for (size_t v = 0; v < mesh.uvs.size(); ++v) mesh.uvs[v] = moved(mesh.uvs[v], of_vertex[v]);
}

/// The upper half in tile 1002, the lower in 1001.
inline void move_half_to_next_tile(Mesh& mesh, float border_y_mm) {
    regroup_uvs(
        mesh, [&](Vec3 p) { return uint32_t(p.y > border_y_mm); },
        [](Vec2 uv, uint32_t group) {
            return Vec2{uv.x + float(group), uv.y};
        });
}

/// The side of x > 0 has the texels of the other one, mirrored; needs a layout that is about symmetrical.
inline void mirror_halves(Mesh& mesh) {
    regroup_uvs(
        mesh, [](Vec3 p) { return uint32_t(p.x > 0); },
        [](Vec2 uv, uint32_t group) {
            return group == 1 ? Vec2{1 - uv.x, uv.y} : uv;
        });
}

/// Eight materials, one for each octant around the middle, with UVs that each fill 0..1.
inline void split_into_eight_materials(SceneObject& object, Vec3 middle_mm) {
    Mesh& mesh = object.mesh;
    const auto octant = [&](Vec3 p) {
        return uint32_t(p.x > middle_mm.x) + 2 * uint32_t(p.y > middle_mm.y) +
               4 * uint32_t(p.z > middle_mm.z);
    };
    std::array<Vec2, 8> low, high;
    low.fill({2, 2}), high.fill({-1, -1});
    std::vector<std::vector<uint32_t>> corners(8);
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        Vec3 p;
        for (size_t k = 0; k < 3; ++k) p += mesh.positions_mm[mesh.indices[3 * t + k]] * (1.0f / 3);
        const uint32_t group = octant(p);
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = mesh.indices[3 * t + k];
            const Vec2 uv = mesh.uvs[vertex];
            corners[group].push_back(vertex);
            low[group] = {std::min(low[group].x, uv.x), std::min(low[group].y, uv.y)};
            high[group] = {std::max(high[group].x, uv.x), std::max(high[group].y, uv.y)};
        }
    }
    const Material material = mesh.materials[0];
    const MaterialClass material_class = object.classes[0];
    mesh.indices.clear(), mesh.submeshes.clear(), mesh.materials.clear(), object.classes.clear();
    for (uint32_t group = 0; group < 8; ++group) {
        mesh.submeshes.push_back({.name = "octant " + std::to_string(group),
                                  .first_index = uint32_t(mesh.indices.size()),
                                  .index_count = uint32_t(corners[group].size()),
                                  .material = group});
        mesh.indices.insert(mesh.indices.end(), corners[group].begin(), corners[group].end());
        mesh.materials.push_back(material);
        mesh.materials.back().name += " " + std::to_string(group);
        object.classes.push_back(material_class);
    }
    regroup_uvs(mesh, octant, [&](Vec2 uv, uint32_t group) {
        const Vec2 size = high[group] - low[group];
        return Vec2{(uv.x - low[group].x) / size.x, (uv.y - low[group].y) / size.y};
    });
}

/// The built-in head, near and complete, without maps, which would move with the UVs.
inline Scene bust_without_maps() {
    Result<Scene> scene = load_built_in_scene("builtin:bust");
    EXPECT_TRUE(scene) << scene.error().message;
    for (SceneObject& object : scene->objects)
        for (Material& material : object.mesh.materials) {
            Material plain;
            plain.name = material.name;
            material = plain;
        }
    EXPECT_TRUE(complete_scene(*scene));
    scene->camera.vertical_fov_rad *= 0.3f;
    scene->camera.target_mm += Vec3{0, 40, 0};
    return std::move(*scene);
}

inline SceneObject& skin_of(Scene& scene) {
    for (SceneObject& object : scene.objects)
        if (object.classes[0] == MaterialClass::skin) return object;
    ADD_FAILURE() << "no skin";
    return scene.objects[0];
}

struct UvVariant {
    std::string name;
    Scene scene;
};

/// The scene with the UVs of two tiles, mirrored halves, eight materials, and none; with the atlas of each.
inline std::vector<UvVariant> uv_variants(const Scene& clean) {
    std::vector<UvVariant> all = {{"tiles", clean}, {"mirrored", clean}, {"eight", clean}, {"none", clean}};
    move_half_to_next_tile(skin_of(all[0].scene).mesh, clean.bounds_center_mm.y);
    mirror_halves(skin_of(all[1].scene).mesh);
    split_into_eight_materials(skin_of(all[2].scene), clean.bounds_center_mm);
    skin_of(all[3].scene).mesh.uvs.clear();
    for (UvVariant& variant : all) {
        lay_out_skin_atlas(variant.scene);
        EXPECT_FALSE(skin_of(variant.scene).mesh.atlas_uvs.empty()) << variant.name;
    }
    return all;
}

}  // namespace dermis
