// How many points of a pixel are enough, and how shares depend on the distance of the camera: shares against
// exact answers, which have no noise.

#include "judge/exact_shares.h"
#include "render/render_test.h"

using namespace dermis;

namespace {

class PixelGrids : public RenderTest {};
class Distances : public RenderTest {};

}  // namespace

TEST_F(PixelGrids, nearly_twice_the_points_of_a_pixel_move_no_share_by_more_than_a_hundredth) {
    constexpr int kSide = 64;  // a shadow's edge wants pixels below 0.2 mm: at 0.3 mm shares move by .03
    const auto list = parse_technique_list(built_in_catalog().techniques,
                                           "preintegrated,texture_space,texture_space_gaussians");
    ASSERT_TRUE(list);
    const int standard = ComparisonSettings{}.grid, finer = 8;
    ASSERT_EQ(standard, 6);
    for (const char* name : {"sphere", "shadow_edge", "relief_0.5mm"}) {
        const SubjectCase one = unit_case(name);
        Renderer renderer = make_renderer(one.scene);
        const auto before = exact_shares(renderer, *list, one.scene, one.exact, kSide, standard),
                   after = exact_shares(renderer, *list, one.scene, one.exact, kSide, finer);
        for (size_t i = 0; i < list->size(); ++i)
            EXPECT_NEAR(before[i], after[i], 0.01) << name << ", " << (*list)[i].name();
    }
}

// A sphere of 4 mm, each time as large in the picture as its distance makes it, a fifth of a mm a pixel to
// one mm. What scatters in millimetres must not depend on it: preintegrated has all of the effect at each
// distance, and no share changes at once from one distance to the next.
TEST_F(Distances, shares_at_ten_distances_of_the_camera) {
    constexpr int kSide = 48, kGrid = 3, kDistances = 10;
    const auto list =
        parse_technique_list(built_in_catalog().techniques, "preintegrated,wrap,screen_space_separable");
    ASSERT_TRUE(list);
    SubjectCase one = unit_case("sphere");
    Renderer renderer = make_renderer(one.scene);
    const Vec3 eye_mm = one.scene.camera.eye_mm;
    std::vector<double> before;
    for (int i = 0; i < kDistances; ++i) {
        one.scene.camera.eye_mm = eye_mm * std::exp2(float(i) / 4);
        fit_depth_range(one.scene.camera, one.scene.bounds_center_mm, one.scene.bounds_radius_mm);
        const std::vector<double> now = exact_shares(renderer, *list, one.scene, one.exact, kSide, kGrid);
        EXPECT_GT(now[0], 0.97) << i;
        for (size_t k = 0; k < now.size() && !before.empty(); ++k)
            EXPECT_NEAR(now[k], before[k], 0.08) << (*list)[k].name() << ", distance " << i;
        before = now;
    }
}
