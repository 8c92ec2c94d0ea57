#include <gtest/gtest.h>

#include <cmath>

#include "dermis/scene/builtin.h"
#include "dermis/scene/scene_description.h"

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

TEST(BuiltinSpheres, are_four_of_radius_2_4_8_16_resting_on_one_line) {
    const Result<Scene> scene = load_scene("builtin:spheres");
    ASSERT_TRUE(scene);
    const std::vector<Ball> all = balls(*scene);
    ASSERT_EQ(all.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(all[i].radius_mm, kSphereRadiiMm[i], 1e-3);
        EXPECT_NEAR(all[i].center_mm.y, kSphereRadiiMm[i], 1e-3);
        const Mesh& mesh = scene->objects[i].mesh;
        ASSERT_EQ(mesh.curvatures_per_mm.size(), mesh.positions_mm.size());
        EXPECT_NEAR(mesh.curvatures_per_mm[100], 1 / kSphereRadiiMm[i], 1e-6);
    }
}

TEST(BuiltinSpheres, do_not_shadow_one_another_under_the_default_key_light) {
    const Result<Scene> scene = load_scene("builtin:spheres");
    ASSERT_TRUE(scene);
    const Vec3 to_light = scene->key_light().to_light_world;
    const std::vector<Ball> all = balls(*scene);
    for (size_t i = 0; i < all.size(); ++i)
        for (size_t j = 0; j < i; ++j) {
            const float apart_mm = length(cross(all[i].center_mm - all[j].center_mm, to_light));
            EXPECT_GT(apart_mm, all[i].radius_mm + all[j].radius_mm) << i << " and " << j;
        }
}

TEST(BuiltinSpheres, wind_counter_clockwise_and_have_tangents_along_u) {
    const Result<Scene> scene = load_scene("builtin:spheres");
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

TEST(BuiltinSpheres, the_default_scene_has_one_key_light_and_frames_its_bounds) {
    const Result<Scene> scene = load_scene("builtin:spheres");
    ASSERT_TRUE(scene);
    int keys = 0;
    for (const Light& light : scene->lights) keys += light.is_key;
    EXPECT_EQ(keys, 1);
    EXPECT_EQ(scene->camera.target_mm, scene->bounds_center_mm);
    for (const SceneObject& object : scene->objects)
        for (const Vec3 p : object.mesh.positions_mm)
            EXPECT_LE(length(p - scene->bounds_center_mm), scene->bounds_radius_mm);
}

TEST(BuiltinGlasses, have_an_opaque_frame_that_is_closed_and_lenses_that_face_forward) {
    const Result<std::vector<SceneObject>> objects = make_builtin_objects("glasses");
    ASSERT_TRUE(objects);
    const SceneObject& glasses = objects->front();
    ASSERT_EQ(glasses.classes, (std::vector{MaterialClass::other, MaterialClass::translucent}));
    const Mesh& mesh = glasses.mesh;
    for (const Submesh& part : mesh.submeshes) {
        double volume_mm3 = 0, area_forward = 0, area = 0;
        for (uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
            const Vec3 a = mesh.positions_mm[mesh.indices[i]], b = mesh.positions_mm[mesh.indices[i + 1]],
                       c = mesh.positions_mm[mesh.indices[i + 2]];
            const Vec3 face = cross(b - a, c - a);
            volume_mm3 += dot(a, cross(b, c)) / 6.0;
            area_forward += face.z / 2.0;
            area += length(face) / 2.0;
        }
        // Tubes of 1.7 to 1.9 mm, about 700 mm of them; two lenses of 52 x 42 mm.
        if (part.name == "frame") {
            EXPECT_NEAR(volume_mm3, 7000, 1500);
        }
        if (part.name == "lens") {
            EXPECT_NEAR(area, 2 * 0.85 * 52 * 42, 250);
            EXPECT_GT(area_forward, 0.9 * area);
        }
    }
}

TEST(BuiltinGlasses, sit_on_the_bust_without_cutting_into_the_eyes) {
    const Result<Scene> scene = load_scene("glasses");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->objects.size(), 2u);
    const SceneObject &bust = scene->objects[0], &glasses = scene->objects[1];
    EXPECT_EQ(glasses.classes[1], MaterialClass::translucent) << "built-in things know their classes";
    const Submesh& lens = glasses.mesh.submeshes[1];
    for (uint32_t i = lens.first_index; i < lens.first_index + lens.index_count; i += 40) {
        const Vec3 p = glasses.mesh.positions_mm[glasses.mesh.indices[i]];
        for (const Vec3 q : bust.mesh.positions_mm)
            if (std::abs(q.x - p.x) < 1 && std::abs(q.y - p.y) < 1) {
                ASSERT_LT(q.z, p.z);
            }
    }
}

TEST(BuiltinBust, is_made_with_the_parameters_of_its_mesh) {
    Result<SceneDescription> description =
        parse_scene("[[mesh]]\nfile = \"builtin:bust\"\ntone = 5\n", "s.toml");
    ASSERT_TRUE(description);
    description->meshes[0].bust.tone = 9;  // what the file's check would not let through shows the way
    EXPECT_EQ(build_scene(*description).error().message,
              "s.toml:2: mesh.file: bust: tone is 9; it must be between 1 and 6");
}

TEST(LoadScene, an_unknown_built_in_name_says_which_exist) {
    EXPECT_EQ(load_scene("builtin:sphere").error().message,
              "unknown built-in scene 'sphere'; did you mean 'spheres'? Known: bust, glasses, spheres");
}
