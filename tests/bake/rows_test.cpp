// Every preset against the tests' own adaptive quadrature, at radii from 0.25 to 1000 mm.

#include "dermis/bake/rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "dermis/base/cache.h"
#include "dermis/optics/presets.h"
#include "optics/adaptive_quadrature.h"

using namespace dermis;

TEST(Rows, every_preset_is_exact_at_every_radius) {
    const std::vector<double> n_dot_l = {-0.7, -0.05, 0, 0.3, 1};
    const std::vector<double> radii_mm = {0.25, 3, 1000};
    for (const std::string& name : profile_names()) {
        const Profile profile = *find_profile(name);
        const Result<std::vector<float>> rows = integrate_rows(profile, n_dot_l, radii_mm, {});
        ASSERT_TRUE(rows) << rows.error().message;
        for (size_t y = 0; y < radii_mm.size(); ++y)
            for (size_t x = 0; x < n_dot_l.size(); ++x) {
                const size_t channel = (x + y) % 3;
                const auto reflectance = [&](double d) {
                    return reflectance_per_mm2(profile, int(channel), std::max(d, 1e-12));
                };
                const double finest_mm = 0.1 * inverse_cdf_mm(profile, int(channel), 0.2);
                const double exact = test::sphere_integral(reflectance, finest_mm, n_dot_l[x], radii_mm[y]);
                EXPECT_NEAR((*rows)[3 * (y * n_dot_l.size() + x) + channel], exact, 1e-6)
                    << name << " r " << radii_mm[y] << " n.l " << n_dot_l[x] << " channel " << channel;
            }
    }
}

TEST(Rows, quadrature_rows_come_back_from_the_cache_as_they_were) {
    const Profile profile = *find_profile("jensen_skin1");
    const std::vector<double> n_dot_l = {-0.5, 0.5}, radii_mm = {2};
    const auto first = *integrate_rows(profile, n_dot_l, radii_mm, {});
    EXPECT_FALSE(std::filesystem::is_empty(cache_directory()));
    EXPECT_EQ(*integrate_rows(profile, n_dot_l, radii_mm, {}), first);
    EXPECT_NE(*integrate_rows(scaled(profile, 2), n_dot_l, radii_mm, {}), first);
}

TEST(Rows, curvature_and_radius_axes_mean_what_they_say) {
    EXPECT_EQ(radius_of({.name = "radius_mm"}, 4), 4);
    EXPECT_EQ(radius_of({.name = "curvature_per_mm"}, 4), 0.25);
    EXPECT_TRUE(std::isinf(radius_of({.name = "curvature_per_mm"}, 0)));
    EXPECT_NE(check_curvature_axis({.name = "curvature_mm"}).error().message.find("did you mean"),
              std::string::npos);
}
