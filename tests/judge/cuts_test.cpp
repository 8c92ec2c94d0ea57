// Which pixels lie beside a cut of the mesh.

#include "dermis/judge/cuts.h"

#include <gtest/gtest.h>
#include <cmath>

#include "dermis/mesh/primitives.h"

using namespace dermis;

namespace {

constexpr int kPixels = 64;
constexpr float kBallMm = 60;

Scene seen_from_the_front(Mesh mesh) {
    Scene scene;
    scene.objects.push_back({.mesh = std::move(mesh), .classes = {MaterialClass::skin}});
    scene.camera = framing_camera({}, kBallMm);
    return scene;
}

// Without all that lies below the height.
Mesh cut_sphere(float lowest_mm) {
    Mesh mesh = make_sphere(kBallMm);
    std::vector<uint32_t> kept;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto corner = [&](size_t k) { return mesh.positions_mm[mesh.indices[3 * t + k]].y; };
        if (std::min({corner(0), corner(1), corner(2)}) >= lowest_mm)
            kept.insert(kept.end(), {mesh.indices[3 * t], mesh.indices[3 * t + 1], mesh.indices[3 * t + 2]});
    }
    mesh.indices = kept;
    mesh.submeshes.clear();
    return mesh;
}

}  // namespace

TEST(Cuts, pixels_beside_the_border_of_a_body_do_not_count) {
    const auto away = away_from_cuts(seen_from_the_front(cut_sphere(-30)), kPixels, kPixels);
    ASSERT_TRUE(away) << away.error().message;
    ASSERT_FALSE(away->empty());
    // The sphere fits the height of the picture, so that a pixel is a little less than 2 mm.
    const auto at = [&](float height_mm) {
        const int y = int(std::lround(kPixels / 2 - height_mm / kBallMm * kPixels / 2));
        return away->at(kPixels / 2, y, 0);
    };
    EXPECT_EQ(at(-24), 0);
    EXPECT_EQ(at(-16), 0);
    EXPECT_EQ(at(0), 1);
    EXPECT_EQ(at(40), 1);
}

TEST(Cuts, all_counts_where_nothing_is_farther_away) {
    const auto away = away_from_cuts(seen_from_the_front(cut_sphere(57)), kPixels, kPixels);
    ASSERT_TRUE(away) << away.error().message;
    EXPECT_TRUE(away->empty());
}

TEST(Cuts, closed_bodies_and_sheets_have_none) {
    for (Mesh mesh : {make_sphere(kBallMm), make_plane(100, 100)}) {
        const auto away = away_from_cuts(seen_from_the_front(std::move(mesh)), kPixels, kPixels);
        ASSERT_TRUE(away) << away.error().message;
        EXPECT_TRUE(away->empty());
    }
}
