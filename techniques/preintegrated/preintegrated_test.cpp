// The shader's diffuse term read back from the device, against the optics library.

#include <gtest/gtest.h>

#include "dermis/optics/curvature_expressions.h"
#include "dermis/optics/curve_2015.h"
#include "render/grid_scene.h"

using namespace dermis;

namespace {

class PreintegratedDiffuse : public PreintegratedTest {
  protected:
    // The largest difference between the picture of the grid and what `expected` says.
    template <class Expected>
    double largest_difference(const std::string& diffuse, Expected expected) {
        const Image image = draw_grid(make_grid_scene(),
                                      {{"diffuse", diffuse}, {"shadow", "plain"}, {"transmission", "none"}});
        double largest = 0;
        for (int y = 0; y < kGrid; ++y)
            for (int x = 0; x < kGrid; ++x) {
                const Rgb d = expected(grid_cosine(x), grid_curvature_per_mm(y));
                for (int c = 0; c < 3; ++c)
                    largest = std::max(largest, std::abs(d[size_t(c)] - double(image.at(x, y, c))));
            }
        return largest;
    }
};

Rgb exact(double t, double curvature_per_mm, const Preintegration& how) {
    return preintegrated_diffuse(gpu_gems_3_skin(), t, 1 / curvature_per_mm, how);
}

}  // namespace

// The published tables differ in the integral and in a factor on the variances.
TEST_F(PreintegratedDiffuse, of_the_table_is_the_librarys) {
    for (const auto& [diffuse, how] :
         {std::pair{"lut", Preintegration{}}, {"half_ring", kUnity2011Ring}, {"full_ring", kYeung2015Ring}}) {
        const auto integral = [&ring = how](double t, double k) { return exact(t, k, ring); };
        EXPECT_LT(largest_difference(diffuse, integral), 1e-3) << diffuse;
    }
}

TEST_F(PreintegratedDiffuse, of_the_closed_form_is_the_librarys_and_near_the_exact) {
    const CurvatureExpressions form = *fit_curvature_expressions(gpu_gems_3_skin());
    const auto positive = [&](double t, double k) {
        Rgb light = evaluate(form, t, k);
        for (double& c : light) c = std::max(c, 0.0);
        return light;
    };
    EXPECT_LT(largest_difference("closed_form", positive), 1e-5);
    EXPECT_LT(largest_difference("closed_form", [](double t, double k) { return exact(t, k, {}); }),
              1.0 / 255);
}

TEST_F(PreintegratedDiffuse, of_the_2015_curves_is_as_published) {
    EXPECT_LT(largest_difference("curve_2015", [](double t, double k) { return curve_2015_direct(t, k); }),
              1e-5);
}
