#include "dermis/scene/skin_tone.h"
#include "support/built_in.h"

#include <gtest/gtest.h>

namespace dermis {
namespace {

Scene spheres() {
    Result<Scene> scene = load_built_in_scene("builtin:spheres");
    EXPECT_TRUE(scene);
    return std::move(*scene);
}

TEST(SkinTone, the_mean_is_the_base_colour_where_there_is_no_map) {
    Scene scene = spheres();
    for (SceneObject& object : scene.objects)
        for (Material& material : object.mesh.materials) material.base_color_linear = {0.5f, 0.25f, 0.125f};
    const Result<Vec3> mean = mean_skin_albedo(scene);
    ASSERT_TRUE(mean) << mean.error().message;
    EXPECT_NEAR(mean->x, 0.5f, 1e-4);
    EXPECT_NEAR(mean->z, 0.125f, 1e-4);
}

TEST(SkinTone, a_map_counts_where_the_skin_uses_it_and_decoded) {
    Scene scene = spheres();
    for (SceneObject& object : scene.objects) {
        object.mesh.uvs.assign(object.mesh.positions_mm.size(), {0.75f, 0.5f});
        for (Material& material : object.mesh.materials) {
            material.base_color_linear = {1, 1, 1};
            constexpr uint8_t kTexels[] = {255, 255, 255, 188, 128, 0};
            const auto pixels = std::as_bytes(std::span(kTexels));
            material.base_color_map = {.name = "two texels",
                                       .width = 2,
                                       .height = 1,
                                       .channels = 3,
                                       .pixels = std::vector(pixels.begin(), pixels.end())};
        }
    }
    const Result<Vec3> mean = mean_skin_albedo(scene);
    ASSERT_TRUE(mean) << mean.error().message;
    EXPECT_NEAR(mean->x, 0.5029f, 1e-3);  // 188 / 255, decoded
    EXPECT_NEAR(mean->y, 0.2159f, 1e-3);
    EXPECT_EQ(mean->z, 0);
}

TEST(SkinTone, the_tint_brings_the_mean_to_the_tone_and_stays_in_its_range) {
    const Vec3 tint = tint_towards({0.3f, 0.2f, 0.9f}, {0.6f, 0.4f, 0.1f});
    EXPECT_FLOAT_EQ(tint.x, 0.5f);
    EXPECT_FLOAT_EQ(tint.y, 0.5f);
    EXPECT_FLOAT_EQ(tint.z, 4);
    EXPECT_EQ(tint_towards({1, 1, 1}, {}).x, 1);
}

TEST(SkinTone, a_scene_without_skin_has_none) {
    Scene scene = spheres();
    for (SceneObject& object : scene.objects)
        object.classes.assign(object.classes.size(), MaterialClass::other);
    EXPECT_FALSE(mean_skin_albedo(scene));
}

}  // namespace
}  // namespace dermis
