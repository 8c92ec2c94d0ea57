#pragma once
// For the tests: a plane whose right half is in shadow, with a choice of UV layouts. The exact result of a
// blur in millimetres at the shadow's edge is known.

#include "dermis/mesh/normals.h"
#include "dermis/mesh/primitives.h"
#include "dermis/mesh/tangents.h"
#include "dermis/scene/placement.h"
#include "render/render_test.h"

namespace dermis {

constexpr float kSideMm = 40, kEdgeMm = 1;  // the plane's; where its shadow begins, in x

// The position in the atlas of a corner of the plane.
using Unwrap = Vec2 (*)(Vec3 p_mm, bool right);

inline Vec2 one_chart(Vec3 p, bool) {
    return {0.5f + 0.8f * p.x / kSideMm, 0.5f - 0.8f * p.y / kSideMm};
}
inline Vec2 stretched(Vec3 p, bool) {
    return {0.5f + 0.96f * p.x / kSideMm, 0.5f - 0.4f * p.y / kSideMm};
}
inline Vec2 sheared(Vec3 p, bool) {
    return {0.5f + 0.6f * p.x / kSideMm + 0.3f * p.y / kSideMm, 0.5f - 0.8f * p.y / kSideMm};
}
// The right half lies apart and is turned by 90 degrees.
inline Vec2 two_charts(Vec3 p, bool right) {
    if (!right) return {0.45f + 0.8f * p.x / kSideMm, 0.5f - 0.8f * p.y / kSideMm};
    return {0.75f + 0.44f * p.y / kSideMm, 0.1f + 1.1f * p.x / kSideMm};
}

inline Mesh plane(Unwrap unwrap) {
    Mesh mesh;
    for (const bool right : {false, true}) {
        const auto first = uint32_t(mesh.positions_mm.size());
        for (const float y : {-0.5f, 0.5f})
            for (const float x : {right ? 0.0f : -0.5f, right ? 0.5f : 0.0f}) {
                const Vec3 p = {x * kSideMm, y * kSideMm, 0};
                mesh.positions_mm.push_back(p);
                mesh.normals.push_back({0, 0, 1});
                mesh.uvs.push_back(unwrap(p, right));
            }
        for (const uint32_t i : {0u, 1u, 3u, 0u, 3u, 2u}) mesh.indices.push_back(first + i);
    }
    mesh.materials.resize(1);
    mesh.materials[0].base_color_linear = {1, 1, 1};
    mesh.submeshes = {{.name = "plane", .first_index = 0, .index_count = uint32_t(mesh.indices.size())}};
    compute_tangents(mesh);
    return mesh;
}

inline Scene half_shadowed(Mesh mesh, float scale = 1) {
    Scene scene;
    scene.objects.push_back({.name = "skin", .mesh = std::move(mesh), .classes = {MaterialClass::skin}});
    SceneObject blocker{.name = "blocker", .mesh = make_plane(30, 60), .classes = {MaterialClass::other}};
    for (Vec3& p : blocker.mesh.positions_mm) p = p + Vec3{15 + kEdgeMm, 0, 60};
    scene.objects.push_back(std::move(blocker));
    for (SceneObject& object : scene.objects) {
        for (Vec3& p : object.mesh.positions_mm) p *= scale;
        object.mesh.occlusions.assign(object.mesh.positions_mm.size(), 1.0f);
    }
    EXPECT_TRUE(complete_scene(scene));
    place_in_studio(scene);
    scene.environment.kind = EnvironmentKind::none;
    scene.lights = {{.name = "key", .intensity = 1, .to_light_world = {0, 0, 1}, .is_key = true}};
    // From the side, below the blocker: 12 mm of the plane around its middle.
    scene.camera = {.eye_mm = Vec3{0, -40, 30} * scale, .target_mm = {}, .vertical_fov_rad = 0.24f};
    fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    return scene;
}

// A wall without light of its own, and a lit one 20 mm before its left half.
inline Scene two_walls() {
    Scene scene = half_shadowed(plane(one_chart));
    scene.objects.resize(1);
    Mesh& mesh = scene.objects[0].mesh;
    const auto corners = uint32_t(mesh.positions_mm.size());
    for (uint32_t i = 0; i < corners; ++i) {
        const bool right = i >= corners / 2;
        if (right) mesh.positions_mm[i].z = -20;
        if (right) mesh.normals[i] = {0, 0, -1};
    }
    scene.camera = {.eye_mm = {0, 0, 100}, .target_mm = {}, .vertical_fov_rad = 0.12f};
    fit_depth_range(scene.camera, {}, 60);
    return scene;
}

}  // namespace dermis
