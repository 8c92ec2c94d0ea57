#include "dermis/bake/lut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

using namespace dermis;

namespace {

LutOptions options(std::string_view convention, int width, int height) {
    LutOptions lut = *lut_options(convention);
    lut.width = width;
    lut.height = height;
    return lut;
}

std::string refusal(const LutOptions& lut) {
    const Result<Table> table = bake_lut(lut);
    return table ? "" : table.error().message;
}

float largest_difference(const Table& a, const Table& b) {
    float worst = 0;
    for (size_t i = 0; i < a.data.size(); ++i) worst = std::max(worst, std::abs(a.data[i] - b.data[i]));
    return worst;
}

}  // namespace

TEST(Lut, texels_are_the_exact_function_at_their_centres) {
    const Table table = *bake_lut(options("dermis", 31, 17));
    for (int y = 0; y < 17; y += 4)
        for (int x = 0; x < 31; x += 5) {
            const double t = -1 + 2 * (x + 0.5) / 31, curvature = 0.5 * (y + 0.5) / 17;
            const Rgb exact = preintegrated_diffuse(gpu_gems_3_skin(), t, 1 / curvature);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(table.at(x, y, c), exact[size_t(c)], 1e-6);
        }
    EXPECT_EQ(table.convention.profile, "gpu_gems_3");
    EXPECT_EQ(table.convention.tool, tool_version());
}

TEST(Lut, a_radius_axis_is_the_same_function) {
    LutOptions by_radius = options("dermis", 16, 8);
    by_radius.convention.axes[1] = radius_axis(2, 18);
    const Table table = *bake_lut(by_radius);
    EXPECT_NEAR(table.at(15, 3, 0), preintegrated_diffuse(gpu_gems_3_skin(), 1 - 1 / 16.0, 9)[0], 1e-6);
}

TEST(Lut, a_mirrored_axis_mirrors_the_table) {
    const Table table = *bake_lut(options("dermis", 12, 9));
    LutOptions mirrored = options("dermis", 12, 9);
    for (TableAxis& axis : mirrored.convention.axes) std::swap(axis.min, axis.max);
    const Table turned = *bake_lut(mirrored);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 12; ++x) EXPECT_NEAR(turned.at(11 - x, 8 - y, 0), table.at(x, y, 0), 1e-6);
}

TEST(Lut, curvature_zero_is_lambert) {
    LutOptions flat = options("dermis", 8, 2);
    flat.convention.axes[1].sampling = TexelSampling::low_edge;
    const Table table = *bake_lut(flat);
    for (int x = 0; x < 8; ++x) EXPECT_NEAR(table.at(x, 0, 0), std::max(0.0, table.u_value(x)), 1e-7);
}

TEST(Lut, a_profile_that_is_no_gaussian_sum_agrees_with_its_fit) {
    LutOptions burley = options("dermis", 16, 6);
    burley.profile = *find_profile("jensen_skin1");
    const Table exact = *bake_lut(burley);
    burley.profile.model = to_gaussian_sum(burley.profile, 8).sum;
    EXPECT_LT(largest_difference(exact, *bake_lut(burley)), 0.01f);
    EXPECT_GT(largest_difference(exact, *bake_lut(options("dermis", 16, 6))), 0.02f);
}

TEST(Lut, every_preset_bakes_and_is_lambert_where_flat) {
    for (const std::string& name : profile_names()) {
        LutOptions lut = options("dermis", 6, 2);
        lut.profile = *find_profile(name);
        lut.convention.axes[1] = radius_axis(1, 4000);
        const Result<Table> table = bake_lut(lut);
        ASSERT_TRUE(table) << name << ": " << table.error().message;
        for (int x = 0; x < 6; ++x)
            EXPECT_NEAR(table->at(x, 1, 0), std::max(0.0, table->u_value(x)), 0.01) << name;
    }
}

// The published loop, written again with its own variables.
TEST(Lut, unity_2011_is_the_published_loop) {
    const int n = 24;
    const Table table = *bake_lut(options("unity_2011", n, n));
    for (int j : {0, 7, 23})
        for (int i : {0, 5, 12, 20}) {
            const double theta = std::acos(-1 + 2.0 * i / n), radius = 2.0 / ((j + 1) / double(n));
            double light = 0, weights = 0;
            for (double a = -std::numbers::pi / 2; a <= std::numbers::pi / 2; a += 0.05) {
                const double d = std::abs(2 * radius * std::sin(a * 0.5));
                double weight = 0;
                for (const GaussianTerm& term : gpu_gems_3_skin().terms) {
                    const double v = term.variance_mm2 * 1.414;
                    weight +=
                        term.weight[0] * std::exp(-d * d / (2 * v)) / std::sqrt(2 * std::numbers::pi * v);
                }
                weights += weight;
                light += weight * std::clamp(std::cos(theta + a), 0.0, 1.0);
            }
            EXPECT_NEAR(table.at(i, j, 0), light / weights, 1e-6) << i << " " << j;
        }
}

TEST(Lut, published_taps_come_near_their_integral) {
    // Measured: a step of 0.05 rad misses the narrowest Gaussian by up to 0.016 at r = 16 mm.
    LutOptions taps = options("unity_2011", 64, 8), exact = taps;
    exact.convention.integration = Integration::exact;
    const float unity = largest_difference(*bake_lut(taps), *bake_lut(exact));
    EXPECT_LT(unity, 0.02f);
    EXPECT_GT(unity, 0.005f);
    LutOptions worked = options("faceworks", 64, 8), ring = worked;
    worked.convention.axes[1] = ring.convention.axes[1] = curvature_axis(0.01, 0.25);
    ring.convention.integration = Integration::exact;
    const float faceworks = largest_difference(*bake_lut(worked), *bake_lut(ring));
    EXPECT_LT(faceworks, 0.02f);
    EXPECT_GT(faceworks, 1e-4f);
}

TEST(Lut, bad_options_are_refused_with_the_value_and_its_range) {
    LutOptions lut = options("dermis", 0, 4);
    EXPECT_EQ(refusal(lut), "table width is 0, must be 1 to 16384");
    lut = options("dermis", 4, 20000);
    EXPECT_EQ(refusal(lut), "table height is 20000, must be 1 to 16384");
    lut = options("dermis", 16384, 16384);
    EXPECT_NE(refusal(lut).find("16384 x 16384 texels"), std::string::npos);
    lut = options("dermis", 4, 4);
    lut.convention.axes[1] = radius_axis(0, 4);
    EXPECT_EQ(refusal(lut), "axis radius_mm has the bound 0, must be 0.001 to 1e+06");
    lut.convention.axes[1] = curvature_axis(-0.1, 4);
    EXPECT_NE(refusal(lut).find("curvature_per_mm has the bound -0.1"), std::string::npos);
    lut.convention.axes[1] = curvature_axis(std::numeric_limits<double>::quiet_NaN(), 1);
    EXPECT_NE(refusal(lut).find("bound nan"), std::string::npos);
    lut.convention.axes[1] = curvature_axis(0.5, 0.5);
    EXPECT_NE(refusal(lut).find("from 0.5 to itself"), std::string::npos);
    lut = options("dermis", 4, 4);
    lut.profile.model = GaussianSum{"mine", {{-1, {1, 1, 1}}}};
    EXPECT_NE(refusal(lut).find("-1"), std::string::npos);
    lut.profile.model = GaussianSum{"mine", {}};
    EXPECT_NE(refusal(lut), "");
    lut = options("penner", 4, 4);
    lut.profile = *find_profile("jensen_skin1");
    EXPECT_NE(refusal(lut).find("needs a sum of Gaussians"), std::string::npos);
    EXPECT_NE(lut_options("penners").error().message.find("did you mean 'penner'?"), std::string::npos);
}

TEST(Lut, lookups_interpolate_between_texel_centres) {
    Table table{.width = 2, .height = 2, .channels = 1, .data = {0, 1, 2, 3}};
    table.convention.axes = {TableAxis{"u", "1", 0, 1}, TableAxis{"v", "1", 0, 1}};
    EXPECT_DOUBLE_EQ(lookup(table, 0.25, 0.25)[0], 0);
    EXPECT_DOUBLE_EQ(lookup(table, 0.75, 0.25)[0], 1);
    EXPECT_DOUBLE_EQ(lookup(table, 0.5, 0.5)[0], 1.5);
    EXPECT_DOUBLE_EQ(lookup(table, -3, 9)[0], 2);
    EXPECT_DOUBLE_EQ(lookup(table, std::nan(""), 0.75)[0], lookup(table, 0, 0.75)[0]);
}

TEST(Lut, axes_map_texels_to_values_and_back) {
    for (AxisWarp warp : {AxisWarp::linear, AxisWarp::squared})
        for (TexelSampling sampling :
             {TexelSampling::centre, TexelSampling::low_edge, TexelSampling::high_edge}) {
            const TableAxis axis{"radius_mm", "mm", 3, 1, warp, sampling};
            for (double texel : {0.0, 1.0, 3.7})
                EXPECT_NEAR(axis.texel(axis.value(texel, 8), 8), texel, 1e-12);
        }
    EXPECT_DOUBLE_EQ((TableAxis{"a", "1", 0, 8}.value(0, 4)), 1);
    EXPECT_DOUBLE_EQ((TableAxis{"a", "1", 0, 8, AxisWarp::squared, TexelSampling::high_edge}.value(1, 4)), 2);
}

TEST(Lut, published_taps_ignore_the_albedo) {
    LutOptions lut = *lut_options("faceworks");
    lut.width = 16, lut.height = 4;
    const Table white = *bake_lut(lut);
    for (GaussianTerm& term : std::get<GaussianSum>(lut.profile.model).terms)
        for (double& weight : term.weight) weight *= 0.3;
    const Table dark = *bake_lut(lut);
    for (size_t i = 0; i < white.data.size(); ++i) EXPECT_NEAR(dark.data[i], white.data[i], 1e-6);
}
