#include "dermis/reference/materials.h"

#include <gtest/gtest.h>

#include "reference/shapes.h"

namespace dermis {
namespace {

ImageSource grey(uint8_t value) {
    return {.name = "occlusion " + std::to_string(value),
            .width = 1,
            .height = 1,
            .channels = 1,
            .pixels = {std::byte{value}}};
}

TEST(Materials, the_vertices_occlusion_and_the_maps_are_counted_once) {
    Scene scene;
    scene.objects.push_back(
        {.name = "sphere", .mesh = test::sphere(20, 2), .classes = {MaterialClass::skin}});
    Mesh& mesh = scene.objects[0].mesh;
    const auto occlusion = [&](float at_vertices, std::optional<uint8_t> in_map) {
        mesh.occlusions.assign(mesh.positions_mm.size(), at_vertices);
        mesh.materials[0].occlusion_map = in_map ? grey(*in_map) : ImageSource{};
        const auto materials = MaterialSet::load(scene);
        EXPECT_TRUE(materials) << materials.error().message;
        return materials->occlusion_at({}, {.object = 0, .triangle = 0});
    };
    EXPECT_NEAR(occlusion(0.5f, {}), 0.5f, 1e-5f);
    EXPECT_NEAR(occlusion(0.5f, 128), 0.5f, 1e-5f);
    EXPECT_NEAR(occlusion(0.5f, 64), 64 / 255.0f, 1e-3f);
    EXPECT_NEAR(occlusion(1, 64), 64 / 255.0f, 1e-3f);
}

}  // namespace
}  // namespace dermis
