// The colour bar of a debug view and the text below it.

#include "dermis/render/legend.h"

#include "render/render_test.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

class Legend : public RenderTest {};

int ink_in(const Image& ink, int x0, int x1, int y0, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) count += ink.at(x, y, 0) > 0.5f;
    return count;
}

}  // namespace

TEST_F(Legend, has_ticks_numbers_and_a_unit) {
    const Result<Image> ink = make_legend("curvature");
    ASSERT_TRUE(ink) << ink.error().message;
    for (const int x : {24, 84, 144, 204, 264}) {
        EXPECT_EQ(ink_in(*ink, x, x + 1, 18, 24), 6) << "tick at " << x;
        EXPECT_GT(ink_in(*ink, x - 12, x + 12, 26, 44), 5) << "number at " << x;
    }
    EXPECT_EQ(ink_in(*ink, 24, 264, 0, 18), 0) << "the bar itself stays free";
    EXPECT_GT(ink_in(*ink, 276, 320, 0, 24), 20) << "the unit";
    EXPECT_EQ(ink_in(*make_legend("albedo"), 0, kLegendWidth, 0, kLegendHeight), 0);
}

TEST_F(Legend, is_drawn_at_the_bottom_of_the_curvature_view_alone) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("lambert");
    const auto picture = [&](const std::string& view) {
        const auto drawn = renderer.draw(technique, small_map_values(technique),
                                         {.width = 400, .height = 200, .view = view});
        EXPECT_TRUE(drawn) << drawn.error().message;
        return *renderer.display();
    };
    const Image curvature = picture("curvature"), albedo = picture("albedo");
    // Begin, middle and end of the bar: concave blue, flat grey, convex red.
    const int y = 200 - 48 + 10, left = 40 + 24;
    EXPECT_GT(curvature.at(left + 3, y, 2), 0.6f);
    EXPECT_LT(curvature.at(left + 3, y, 0), 0.3f);
    EXPECT_NEAR(curvature.at(left + 119, y, 0), curvature.at(left + 119, y, 2), 0.05);
    EXPECT_GT(curvature.at(left + 237, y, 0), 0.6f);
    EXPECT_LT(curvature.at(left + 237, y, 2), 0.3f);
    EXPECT_EQ(albedo.at(left + 3, y, 2), albedo.at(5, 5, 2));
    // Ticks and words are white.
    int white = 0;
    for (int row = 200 - 30; row < 200; ++row)
        for (int x = 40; x < 360; ++x) white += curvature.at(x, row, 1) > 0.8f;
    EXPECT_GT(white, 60);
}
