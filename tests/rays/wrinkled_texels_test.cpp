// Wrinkle maps in the texels that baked normals are made of.

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/mesh/primitives.h"
#include "dermis/rays/skin_points.h"

namespace dermis {
namespace {

ImageSource leaning(const std::string& name, float x) {
    std::vector<std::byte> pixels;
    for (const float value : {x, 0.0f, std::sqrt(1 - x * x)})
        pixels.push_back(std::byte(std::lround(255 * (0.5f + 0.5f * value))));
    return {.name = name, .width = 1, .height = 1, .channels = 3, .pixels = std::move(pixels)};
}

Scene tense_plane(float tension) {
    Scene scene;
    scene.objects.push_back({.name = "skin", .mesh = make_plane(50, 50), .classes = {MaterialClass::skin}});
    Mesh& mesh = scene.objects[0].mesh;
    mesh.tensions.assign(mesh.positions_mm.size(), tension);
    Material& material = mesh.materials[0];
    material.normal_map = leaning("normal", 0);
    material.wrinkle_stretch_map = leaning("stretch", 0.6f);
    material.wrinkle_compress_map = leaning("compress", -0.8f);
    material.wrinkle_from = 0.1f, material.wrinkle_full = 0.3f;
    return scene;
}

float lean_at(float tension, const TargetWeights& weights = {}) {
    Scene scene = tense_plane(tension);
    scene.objects[0].target_weights = weights;
    Material& material = scene.objects[0].mesh.materials[0];
    material.wrinkle_stretch_target = "raise", material.wrinkle_compress_target = "squeeze";
    if (tension == 0) scene.objects[0].mesh.tensions.clear();
    const auto reader = SkinTexelReader::create(scene);
    EXPECT_TRUE(reader) << reader.error().message;
    const SkinTexels texels = reader->read(8);
    const Vec3 n = texels.texels[8 * 4 + 4].n;
    EXPECT_NEAR(n.y, 0, 0.01f);
    return n.x;
}

}  // namespace

TEST(WrinkledTexels, have_the_normals_of_the_map_of_their_tensions_sign_by_its_share) {
    for (const auto& [tension, expected] : {std::pair{0.0f, 0.0f},
                                            {0.09f, 0.0f},
                                            {0.2f, 0.3f},
                                            {0.3f, 0.6f},
                                            {2.0f, 0.6f},
                                            {-0.09f, 0.0f},
                                            {-0.15f, -0.2f},
                                            {-0.3f, -0.8f}})
        EXPECT_NEAR(lean_at(tension), expected, 0.01f) << tension;
}

TEST(WrinkledTexels, have_a_targets_weight_as_the_least_share_of_its_map) {
    EXPECT_EQ(lean_at(0, {{"raise", 1.0f}}), lean_at(2));
    EXPECT_EQ(lean_at(0, {{"squeeze", 7.0f}}), lean_at(-2)) << "clamped";
    EXPECT_EQ(lean_at(0.2f, {{"raise", 0.0f}}), lean_at(0.2f));
    EXPECT_EQ(lean_at(0.2f, {{"raise", -1.0f}}), lean_at(0.2f));
    EXPECT_EQ(lean_at(0.2f, {{"raise", 0.4f}}), lean_at(0.2f)) << "half by tension";
    EXPECT_NEAR(lean_at(0.12f, {{"raise", 0.5f}}), 0.3f, 0.01f) << "a tenth by tension";
    EXPECT_NEAR(lean_at(0, {{"raise", 0.25f}, {"squeeze", 0.5f}}), 0.25f * 0.6f - 0.5f * 0.8f, 0.01f);
    EXPECT_NEAR(lean_at(2, {{"squeeze", 1.0f}}), 0.5f * 0.6f - 0.5f * 0.8f, 0.01f) << "one of both in all";
}

}  // namespace dermis
