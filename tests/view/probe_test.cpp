#include "dermis/view/probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/mesh/primitives.h"
#include "subjects/spheres/spheres.h"
#include "support/built_in.h"

namespace dermis::view {
namespace {

// One sphere in the middle, seen from the front.
Scene sphere_scene(float radius_mm) {
    Result<Scene> spheres = load_built_in_scene("builtin:spheres");
    EXPECT_TRUE(spheres);
    Scene scene = std::move(*spheres);
    for (SceneObject& object : scene.objects) {
        Mesh& mesh = object.mesh;
        for (size_t i = 0; i < mesh.normals.size(); ++i)
            mesh.curvatures_per_mm[i] = isotropic_curvature(1 / radius_mm, mesh.normals[i]);
    }
    return scene;
}

TEST(Probe, reads_the_diameter_and_the_curvature_of_a_sphere) {
    const Scene scene = sphere_scene(16);
    const Result<Probe> probe = Probe::create(scene);
    ASSERT_TRUE(probe) << probe.error().message;
    // The largest sphere is the last; look straight at its middle.
    Vec3 low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
    for (const Vec3& p : scene.objects.back().mesh.positions_mm) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const float right_mm = high.x - kSphereRadiiMm[3];
    const Vec3 center{right_mm, (high.y + low.y) / 2, (high.z + low.z) / 2};
    Camera camera{.eye_mm = {right_mm, center.y, 500}, .target_mm = center};
    const auto reading = probe->at(camera, {0.5f, 0.5f}, 1.5f);
    ASSERT_TRUE(reading);
    ASSERT_TRUE(reading->thickness_mm);
    EXPECT_NEAR(*reading->thickness_mm, 32, 0.5);
    EXPECT_NEAR(reading->curvature_per_mm, 1.0 / 16, 1e-4);
    EXPECT_THAT(probe_text(*reading), ::testing::HasSubstr("(radius 16.0 mm)"));
    EXPECT_FALSE(probe->at(camera, {0.01f, 0.01f}, 1.5f));
}

}  // namespace
}  // namespace dermis::view
