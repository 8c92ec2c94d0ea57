#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "dermis/mesh/topology.h"
#include "dermis/scene/placement.h"
#include "subjects/spheres/spheres.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

struct Ball {
    Vec3 center_mm;
    float radius_mm;
};

std::vector<Ball> balls(const Scene& scene) {
    std::vector<Ball> result;
    for (const SceneObject& object : scene.objects) {
        Scene alone{.objects = {object}};
        compute_bounds(alone);
        result.push_back({alone.bounds_center_mm, alone.bounds_radius_mm});
    }
    return result;
}

}  // namespace

TEST(Spheres, are_four_of_radius_2_4_8_16_that_touch_one_plane) {
    const Result<Scene> scene = load_built_in_scene("builtin:spheres");
    ASSERT_TRUE(scene);
    const std::vector<Ball> all = balls(*scene);
    ASSERT_EQ(all.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(all[i].radius_mm, kSphereRadiiMm[i], 1e-3);
        EXPECT_NEAR(all[i].center_mm.y, kSphereRadiiMm[i], 1e-3);
        const Mesh& mesh = scene->objects[i].mesh;
        ASSERT_EQ(mesh.curvatures_per_mm.size(), mesh.positions_mm.size());
        EXPECT_NEAR(mean_curvature(mesh.curvatures_per_mm[100]), 1 / kSphereRadiiMm[i], 1e-6);
    }
}

// What looks for neighbours (blurs over the atlas, cavities) finds them by equal positions.
TEST(Spheres, are_closed_at_the_seam_and_the_poles) {
    const Result<Scene> scene = load_built_in_scene("builtin:spheres");
    ASSERT_TRUE(scene);
    for (const SceneObject& object : scene->objects) {
        const Mesh& mesh = object.mesh;
        const Weld weld = weld_positions(mesh.positions_mm);
        EXPECT_EQ(weld.count(), 47u * 96 + 2);
        std::map<std::pair<uint32_t, uint32_t>, int> sides;
        for (size_t i = 0; i < mesh.indices.size(); ++i) {
            const size_t next = i % 3 == 2 ? i - 2 : i + 1;
            const auto [a, b] = std::minmax(weld.ids[mesh.indices[i]], weld.ids[mesh.indices[next]]);
            ++sides[{a, b}];
        }
        for (const auto& [edge, count] : sides) ASSERT_EQ(count, 2) << object.name;
    }
}

TEST(Spheres, do_not_shadow_one_another_under_the_default_key_light) {
    const Result<Scene> scene = load_built_in_scene("builtin:spheres");
    ASSERT_TRUE(scene);
    const Vec3 to_light = scene->key_light().to_light_world;
    const std::vector<Ball> all = balls(*scene);
    for (size_t i = 0; i < all.size(); ++i)
        for (size_t j = 0; j < i; ++j) {
            const float apart_mm = length(cross(all[i].center_mm - all[j].center_mm, to_light));
            EXPECT_GT(apart_mm, all[i].radius_mm + all[j].radius_mm) << i << " and " << j;
        }
}

TEST(Spheres, are_as_far_apart_as_the_parameter_says) {
    for (const char* gap_mm : {"", "0", "20"}) {
        std::map<std::string, std::string> words;
        if (*gap_mm) words["gap_mm"] = gap_mm;
        const auto made = make_subject(built_in_catalog().subjects, "spheres", words);
        ASSERT_TRUE(made) << made.error().message;
        const std::vector<Ball> all = balls({.objects = made->objects});
        for (size_t i = 1; i < 4; ++i)
            EXPECT_NEAR(all[i].center_mm.x - all[i - 1].center_mm.x,
                        all[i].radius_mm + all[i - 1].radius_mm + (*gap_mm ? std::atof(gap_mm) : 8), 1e-3);
    }
}

TEST(Spheres, wind_counter_clockwise_and_have_tangents_along_u) {
    const Result<Scene> scene = load_built_in_scene("builtin:spheres");
    ASSERT_TRUE(scene);
    const Mesh& mesh = scene->objects[2].mesh;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t* corner = &mesh.indices[i];
        const Vec3 a = mesh.positions_mm[corner[0]], b = mesh.positions_mm[corner[1]],
                   c = mesh.positions_mm[corner[2]];
        const Vec3 face = cross(b - a, c - a);
        ASSERT_GT(dot(face, mesh.normals[corner[0]]), 0) << "triangle " << i / 3;
    }
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i) {
        const Vec4 t = mesh.tangents[i];
        ASSERT_NEAR(dot(Vec3{t.x, t.y, t.z}, mesh.normals[i]), 0, 1e-5);
    }
}

TEST(Spheres, the_default_scene_has_one_key_light_and_frames_its_bounds) {
    const Result<Scene> scene = load_built_in_scene("builtin:spheres");
    ASSERT_TRUE(scene);
    int keys = 0;
    for (const Light& light : scene->lights) keys += light.is_key;
    EXPECT_EQ(keys, 1);
    EXPECT_EQ(scene->camera.target_mm, scene->bounds_center_mm);
    for (const SceneObject& object : scene->objects)
        for (const Vec3 p : object.mesh.positions_mm)
            EXPECT_LE(length(p - scene->bounds_center_mm), scene->bounds_radius_mm);
}
