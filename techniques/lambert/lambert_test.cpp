#include <gtest/gtest.h>

#include <algorithm>

#include "render/grid_scene.h"

using namespace dermis;

namespace {

class Lambert : public GridTest {};

}  // namespace

TEST_F(Lambert, is_the_clamped_cosine_whatever_the_curvature) {
    const Image image = draw_grid(make_grid_scene(), built_in_technique("lambert"), {{"specular", "none"}});
    for (int y = 0; y < kGrid; ++y)
        for (int x = 0; x < kGrid; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(image.at(x, y, c), std::max(grid_cosine(x), 0.0), 1e-5) << x << " " << y;
}
