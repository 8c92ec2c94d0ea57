#include <gtest/gtest.h>

#include <cmath>

#include "support/built_in.h"

using namespace dermis;

TEST(Glasses, have_an_opaque_frame_that_is_closed_and_lenses_that_face_forward) {
    const Result<SubjectScene> made = make_subject(built_in_catalog().subjects, "glasses");
    ASSERT_TRUE(made);
    const SceneObject& glasses = made->objects.front();
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

TEST(Glasses, sit_on_the_bust_without_cutting_into_the_eyes) {
    const Result<Scene> scene = load_built_in_scene("glasses");
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
