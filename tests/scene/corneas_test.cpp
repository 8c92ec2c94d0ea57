#include "dermis/scene/corneas.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/mesh/primitives.h"

using namespace dermis;

namespace {

constexpr float kRadius_mm = 12, kBulge_mm = 1.3f, kCornea_rad = 0.5f;

// An eyeball that faces z: a sphere with a cornea that rises over it.
Mesh eyeball(bool has_cornea) {
    Mesh ball = make_sphere(kRadius_mm, 96);
    for (Vec3& p : ball.positions_mm) {
        const float angle = std::acos(std::clamp(p.z / kRadius_mm, -1.0f, 1.0f));
        const float part = std::max(1 - angle * angle / (kCornea_rad * kCornea_rad), 0.0f);
        if (has_cornea) p = p * (1 + part * kBulge_mm / kRadius_mm);
    }
    return ball;
}

void append(Mesh& mesh, const Mesh& other, const std::string& material) {
    const auto base = uint32_t(mesh.positions_mm.size());
    mesh.submeshes.push_back(
        {"", uint32_t(mesh.indices.size()), uint32_t(other.indices.size()), uint32_t(mesh.materials.size())});
    mesh.materials.push_back({.name = material});
    for (const uint32_t i : other.indices) mesh.indices.push_back(base + i);
    mesh.positions_mm.insert(mesh.positions_mm.end(), other.positions_mm.begin(), other.positions_mm.end());
    mesh.uvs.insert(mesh.uvs.end(), other.uvs.begin(), other.uvs.end());
}

struct Eye {
    Mesh mesh;
    std::vector<FoundPart> parts = {{HeadPart::eye, "a"}, {HeadPart::eye, "b"}};
};

Eye eye_of(bool has_cornea, const std::string& inner_name) {
    Eye eye;
    append(eye.mesh, eyeball(has_cornea), "Sclera");
    append(eye.mesh, make_sphere(10, 16), inner_name);
    return eye;
}

}  // namespace

TEST(Corneas, over_an_iris_are_cut_out_at_their_border) {
    Eye eye = eye_of(true, "Iris");
    cut_out_corneas(eye.mesh, eye.parts);
    const Material& sclera = eye.mesh.materials[0];
    ASSERT_EQ(sclera.alpha_mode, AlphaMode::mask);
    const ImageSource& map = sclera.alpha_map;
    const auto vertices = make_sphere(kRadius_mm, 96).positions_mm.size();
    for (size_t v = 0; v < vertices; ++v) {
        const Vec3 n = normalize(eye.mesh.positions_mm[v]);
        const float angle = std::acos(std::clamp(n.z, -1.0f, 1.0f));
        const Vec2 uv = eye.mesh.uvs[v];
        const int x = int(uv.x * float(map.width)), y = int(uv.y * float(map.height));
        if (x < 2 || y < 2 || x >= map.width - 2 || y >= map.height - 2) continue;
        const int alpha = int(map.pixels[size_t(y) * size_t(map.width) + size_t(x)]);
        if (angle < kCornea_rad - 0.1f) EXPECT_LT(alpha, 128) << angle;
        if (angle > kCornea_rad + 0.1f) EXPECT_GT(alpha, 128) << angle;
    }
    EXPECT_NE(eye.parts[0].reason.find("cornea"), std::string::npos);
    EXPECT_EQ(eye.mesh.materials[1].alpha_mode, AlphaMode::opaque);
}

TEST(Corneas, stay_where_no_iris_is_named_where_nothing_bulges_and_where_the_file_has_a_map) {
    for (Eye eye : {eye_of(true, "Inner"), eye_of(false, "Iris")}) {
        cut_out_corneas(eye.mesh, eye.parts);
        EXPECT_EQ(eye.mesh.materials[0].alpha_mode, AlphaMode::opaque);
    }
    Eye mapped = eye_of(true, "Iris");
    mapped.mesh.materials[0].base_color_map.name = "eye.png";
    cut_out_corneas(mapped.mesh, mapped.parts);
    EXPECT_EQ(mapped.mesh.materials[0].alpha_mode, AlphaMode::opaque);
}

TEST(Corneas, of_flat_and_tiny_surfaces_are_left_alone) {
    Eye eye;
    append(eye.mesh, make_plane(10, 10, 8), "Sclera");
    append(eye.mesh, make_sphere(10, 16), "Iris");
    cut_out_corneas(eye.mesh, eye.parts);
    EXPECT_EQ(eye.mesh.materials[0].alpha_mode, AlphaMode::opaque);
}
