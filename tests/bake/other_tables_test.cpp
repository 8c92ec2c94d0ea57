// Zonal harmonics, Beckmann and shadow tables.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/table_report.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "dermis/optics/presets.h"
#include "support/temporary_directory.h"
#include "test_parts.h"

using namespace dermis;

namespace {

Profile skin() {
    return *find_profile("gpu_gems_3");
}

// The edge blurred by taps, straight from the definition.
double blurred_by_taps(double position, double sigma, double sharpening) {
    double sum = 0, weights = 0;
    for (int i = -4000; i <= 4000; ++i) {
        const double d = 8 * sigma * i / 4000, weight = std::exp(-d * d / (2 * sigma * sigma));
        const double u = std::clamp(0.5 + sharpening * (position + d - 0.5), 0.0, 1.0);
        sum += weight * u * u * (3 - 2 * u);
        weights += weight;
    }
    return sum / weights;
}

}  // namespace

TEST(ZonalTable, rows_are_the_orders) {
    for (const char* name : {"gpu_gems_3", "jensen_skin2"}) {
        const Profile profile = *find_profile(name);
        const Table table = *bake_zonal_harmonics({.profile = profile, .width = 12});
        ASSERT_EQ(table.height, 3);
        for (int l = 0; l < 3; ++l) {
            EXPECT_DOUBLE_EQ(table.v_value(l), l);
            const auto exact = zonal_harmonics_at(profile, 1 / table.u_value(7), {});
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(table.at(7, l, c), exact[size_t(l)][size_t(c)], 1e-6);
        }
        EXPECT_NEAR(table.at(3, 0, 0), std::sqrt(std::numbers::pi) / 2, 1e-7);
    }
}

TEST(ZonalTable, the_remapped_layout_keeps_8_bit_values_within_half_a_step) {
    const Table table =
        *bake_zonal_harmonics({.profile = skin(), .width = 64, .layout = ZonalLayout::two_rows_remapped_8});
    ASSERT_EQ(table.height, 2);
    const Table stored = quantised(table, TableStorage::u8);
    for (size_t i = 0; i < table.data.size(); ++i)
        EXPECT_NEAR(stored.data[i], table.data[i], 0.5 * (1.05 - 0.75) / 255 + 1e-6);
    EXPECT_NEAR(encode_value(table.convention, 0.9, 0), 0.5, 1e-12);
}

// The file itself, byte by byte, and what a reader gets from it.
TEST(ZonalTable, the_remapped_png_reads_back_as_what_it_should_hold) {
    DERMIS_NEEDS(PNG);
    const Profile profile = skin();
    const Preintegration how = {.construction = Construction::half_ring};
    const Table table = *bake_zonal_harmonics(
        {.profile = profile, .width = 32, .how = how, .layout = ZonalLayout::two_rows_remapped_8});
    const TemporaryDirectory directory;
    const auto path = directory.path / "zh.png";
    ASSERT_TRUE(write_table(path, table, TableStorage::u8));

    const Image codes = read_image(path, ImageUse::data)->image;
    ASSERT_EQ(codes.format, PixelFormat::u8);
    ASSERT_EQ(std::pair(codes.width, codes.height), std::pair(32, 2));
    EXPECT_FALSE(png_is_flagged_srgb(*read_file(path)));
    const auto read = read_table(path, {.kind = TableKind::zonal_harmonics,
                                        .construction = Construction::half_ring,
                                        .u_axis = "curvature_per_mm",
                                        .v_axis = "order",
                                        .profile = profile.name});
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->convention.encoding, TableEncoding::range);
    EXPECT_EQ(std::pair(read->convention.encoded_min, read->convention.encoded_max), std::pair(0.75, 1.05));
    int different_codes = 0;
    for (int x = 0; x < 32; ++x) {
        const double curvature = 0.5 * (x + 0.5) / 32;
        const auto exact = preintegrated_zonal_harmonics(gpu_gems_3_skin(), 1 / curvature, how);
        for (int l = 0; l < 2; ++l)
            for (int c = 0; c < 3; ++c) {
                const double value = exact[size_t(l)][size_t(c)];
                const double code = std::round((value - 0.75) / (1.05 - 0.75) * 255);
                EXPECT_EQ(std::round(codes.at(x, l, c) * 255), code) << x << ", " << l;
                EXPECT_NEAR(read->at(x, l, c), value, 0.5 * (1.05 - 0.75) / 255 + 1e-6);
                different_codes += code != std::round((exact[size_t(l)][1] - 0.75) / 0.3 * 255);
            }
    }
    EXPECT_GT(different_codes, 32) << "red is another curve than green";
}

// Files of version 0.1 call the full ring "ring"; on the command line that word could mean either.
TEST(Convention, an_old_file_with_a_ring_means_the_full_one) {
    const Table table =
        *bake_zonal_harmonics({.profile = skin(), .how = {.construction = Construction::full_ring}});
    std::string json = convention_json(table.convention, table.width, table.height);
    const size_t at = json.find("full_ring");
    ASSERT_NE(at, std::string::npos);
    const auto read = parse_convention(json.replace(at, 9, "ring"), "old.json");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->convention.how.construction, Construction::full_ring);
    EXPECT_EQ(find_construction("ring").error().message,
              "construction 'ring' is either: full_ring or half_ring (-90 to 90 degrees)");
}

TEST(Beckmann, is_a_normalised_distribution) {
    // int D cos over the hemisphere is 1 once divided by pi.
    for (double m : {0.1, 0.3, 0.8}) {
        double sum = 0;
        const int n = 20000;
        for (int i = 0; i < n; ++i) {
            const double cosine = (i + 0.5) / n;
            sum += beckmann(cosine, m) * cosine * 2 / n;  // 2 pi / pi
        }
        EXPECT_NEAR(sum, 1, 1e-4) << m;
    }
}

TEST(Beckmann, its_limits_are_finite_numbers) {
    const Table table = *bake_beckmann({.width = 16, .height = 16, .layout = BeckmannLayout::gems_8_bit});
    for (float value : table.data) EXPECT_TRUE(std::isfinite(value));
    EXPECT_EQ(table.at(0, 5, 0), 0);
    EXPECT_EQ(table.at(5, 0, 0), 0);
    EXPECT_NEAR(table.at(8, 4, 0), std::exp(-3 / 0.0625) / (0.0625 * 0.0625), 1e-20);
    EXPECT_NEAR(encode_value(table.convention, 1024, 0), 1, 1e-12);
    EXPECT_NEAR(decode_value(table.convention, 0.5, 0), 1, 1e-12);
}

TEST(ShadowTable, is_the_edge_blurred_by_the_profile) {
    for (double sharpening : {1.0, 3.0, 10.0})
        for (double sigma : {0.002, 0.03, 0.1, 0.166, 0.17, 0.5, 3.0, 8.0})
            for (double position : {0.0, 0.2, 0.45, 0.5, 0.8, 1.0})
                EXPECT_NEAR(blurred_smoothstep(position, sigma, sharpening),
                            blurred_by_taps(position, sigma, sharpening), 2e-6)
                    << position << " " << sigma << " " << sharpening;
}

TEST(ShadowTable, methods_agree_where_they_change) {
    for (double position : {0.0, 0.1, 0.5, 0.7, 1.0})
        EXPECT_NEAR(blurred_smoothstep(position, 0.5 - 1e-13, 1),
                    blurred_smoothstep(position, 0.5 + 1e-13, 1), 1e-11);
}

TEST(ShadowTable, wide_penumbrae_tend_to_the_light_itself_and_lit_plus_dark_is_one) {
    const ShadowOptions options{
        .profile = skin(), .width = 32, .height = 8, .min_width_mm = 1, .max_width_mm = 9000};
    const Table table = *bake_shadow(options);
    for (int x = 0; x < 32; ++x) {
        const double u = std::clamp(0.5 + 3 * ((x + 0.5) / 32 - 0.5), 0.0, 1.0);
        EXPECT_NEAR(table.at(x, 7, 0), u * u * (3 - 2 * u), 1e-3);
        for (int y = 0; y < 8; ++y) EXPECT_NEAR(table.at(x, y, 0) + table.at(31 - x, y, 0), 1, 1e-6);
        EXPECT_GE(table.at(x, 0, 0), table.at(std::max(0, x - 1), 0, 0));
    }
}

TEST(ShadowTable, bad_options_are_refused) {
    const auto refusal = [](ShadowOptions options) { return bake_shadow(options).error().message; };
    EXPECT_EQ(refusal({.profile = skin(), .sharpening = 0.5}), "sharpening is 0.5, must be 1 to 1000");
    EXPECT_NE(refusal({.profile = skin(), .min_width_mm = 0}).find("penumbra_width_mm has the bound 0"),
              std::string::npos);
    EXPECT_NE(refusal({.profile = skin(), .width = -3}).find("width is -3"), std::string::npos);
    EXPECT_NE(refusal({.profile = {.name = "none", .model = GaussianSum{}}}), "");
}

TEST(TableReport, the_error_of_a_lookup_falls_with_the_size) {
    const Profile profile = skin();
    double previous = 1;
    for (int width : {16, 64, 256}) {
        const Table table = *bake_zonal_harmonics({.profile = profile, .width = width});
        const Result<LookupError> error = lookup_error(table, exact_function(table, profile));
        ASSERT_TRUE(error);
        EXPECT_LT(error->max, previous / 8);
        EXPECT_LE(error->rms, error->max);
        previous = error->max;
    }
}

TEST(TableReport, plots_have_a_panel_for_each_channel_and_one_for_the_error) {
    const Profile profile = skin();
    const Table shadow = *bake_shadow({.profile = profile, .width = 16, .height = 8});
    const Plot plot = *table_plot(shadow, profile, TableStorage::f16);
    ASSERT_EQ(plot.panels.size(), 4u);
    ASSERT_EQ(plot.panels[0].series.size(), 4u);
    EXPECT_EQ(plot.panels[0].series[0].name, "w = 2 mm");
    const Table beckmann_table = *bake_beckmann({.width = 16, .height = 16});
    EXPECT_EQ(table_plot(beckmann_table, Profile{}, TableStorage::f32)->panels.size(), 2u);
}
