// Tension against closed forms: a plane, rigid motion, seams.

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/mesh/tension.h"

using namespace dermis;

namespace {

// A square of side 6 mm, irregular inside; its middle column of vertices is there twice, as on a UV seam.
Mesh seamed_plane() {
    Mesh mesh;
    const auto add_half = [&](float from_x) {
        const auto first = uint32_t(mesh.positions_mm.size());
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                const bool inside = x > 0 && x < 3 && y > 0 && y < 3;
                const float shift = inside ? 0.3f * float((x * 7 + y * 3) % 5 - 2) : 0;
                mesh.positions_mm.push_back({from_x + float(x) + shift, 2 * float(y) - shift, 0});
            }
        for (uint32_t y = 0; y < 3; ++y)
            for (uint32_t x = 0; x < 3; ++x) {
                const uint32_t a = first + 4 * y + x, b = a + 4;
                mesh.indices.insert(mesh.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
            }
    };
    add_half(0), add_half(3);
    return mesh;
}

template <class Move>
std::vector<float> tensions_of(const Mesh& rest, const Move& move) {
    std::vector<Vec3> posed_mm;
    for (const Vec3 p : rest.positions_mm) posed_mm.push_back(move(p));
    return compute_tensions(rest_areas(rest.positions_mm, rest.indices), posed_mm, rest.indices);
}

}  // namespace

TEST(Tension, of_a_plane_is_the_sum_of_the_logarithms_of_its_principal_stretches) {
    const Mesh plane = seamed_plane();
    for (const float t : tensions_of(plane, [](Vec3 p) { return Vec3{2 * p.x, p.y, p.z}; }))
        EXPECT_NEAR(t, std::log(2.0f), 1e-5f);
    for (const float t : tensions_of(plane, [](Vec3 p) { return Vec3{0.8f * p.x, 0.5f * p.y, p.z}; }))
        EXPECT_NEAR(t, std::log(0.4f), 1e-5f);
    for (const float t : tensions_of(plane, [](Vec3 p) { return Vec3{p.x + 0.7f * p.y, p.y, p.z}; }))
        EXPECT_NEAR(t, 0, 1e-5f) << "a shear keeps areas";
}

TEST(Tension, is_0_at_rest_and_in_rigid_motion) {
    const Mesh plane = seamed_plane();
    for (const float t : tensions_of(plane, [](Vec3 p) { return p; })) EXPECT_EQ(t, 0);
    const auto turned = [](Vec3 p) { return Vec3{0.6f * p.x - 0.8f * p.y + 20, 9, 0.8f * p.x + 0.6f * p.y}; };
    for (const float t : tensions_of(plane, turned)) EXPECT_NEAR(t, 0, 1e-5f);
}

TEST(Tension, is_the_same_on_both_sides_of_a_seam) {
    const Mesh plane = seamed_plane();
    const std::vector<float> tensions = tensions_of(plane, [](Vec3 p) {
        return Vec3{p.x * (1 + 0.1f * p.x), p.y, 0};
    });
    for (size_t y = 0; y < 4; ++y) EXPECT_EQ(tensions[4 * y + 3], tensions[16 + 4 * y]);
    EXPECT_LT(tensions[0], tensions[19]) << "it grows with x";
}

TEST(Tension, of_a_surface_that_collapses_or_has_no_area_is_finite) {
    const Mesh plane = seamed_plane();
    for (const float t : tensions_of(plane, [](Vec3) { return Vec3{1, 2, 3}; })) EXPECT_EQ(t, -kMostTension);
    Mesh point = plane;
    for (Vec3& p : point.positions_mm) p = {0, 0, p.x};
    for (const float t : tensions_of(point, [](Vec3 p) { return Vec3{p.z, p.z * p.z, 0}; })) EXPECT_EQ(t, 0);
}
