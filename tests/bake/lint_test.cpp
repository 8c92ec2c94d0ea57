// Tables of each convention are recognised after they were rotated, wrongly encoded and stored as files.

#include "dermis/bake/lint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bake/lint_tables.h"
#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/lint_model.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/rows.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/bake/table_io.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/image/colour.h"
#include "dermis/image/io.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "support/temporary_directory.h"
#include "test_parts.h"

using namespace dermis;
using namespace dermis::test;

namespace {

Image transposed(const Image& image) {
    Image turned(image.height, image.width, 3, image.format);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) turned.set(y, x, c, image.at(x, y, c));
    return turned;
}

}  // namespace

TEST(Lint, an_exact_table_needs_nothing) {
    const LintReport report = *lint_table(picture_of(baked("dermis"), PixelFormat::f16, as_it_is));
    EXPECT_TRUE(report.explained);
    EXPECT_EQ(report.best.how.construction, Construction::sphere);
    EXPECT_EQ(report.best.profile, "gpu_gems_3");
    EXPECT_EQ(report.best.stored_as, StoredAs::linear);
    EXPECT_EQ(report.best.axis.name, "curvature_per_mm");
    EXPECT_NEAR(report.best.axis.min, 0, 0.003);
    EXPECT_NEAR(report.best.axis.max, 0.5, 0.003);
    EXPECT_LT(report.error_max, 1e-3);
    EXPECT_TRUE(mentions(report.advice, "no change"));
    EXPECT_TRUE(mentions(report.advice, "vec2(0.5 + 0.5 * n_dot_l, curvature_per_mm / 0.5)"));
    EXPECT_GT(report.runner_up.rms, 10 * report.best.rms);
}

TEST(Lint, the_unity_table_is_recognised_by_its_taps_and_its_direction) {
    DERMIS_NEEDS(PNG);
    const TemporaryDirectory dir;
    ASSERT_TRUE(write_table(dir.path / "a.png", baked("unity_2011"), TableStorage::u8));
    const LintReport report = *lint_file(dir.path / "a.png");
    EXPECT_EQ(report.best.integration, Integration::unity_taps);
    EXPECT_EQ(report.best.sampling, TexelSampling::low_edge);
    EXPECT_FALSE(report.best.transposed || report.best.n_dot_l_mirrored);
    EXPECT_EQ(report.best.v_origin, VOrigin::bottom);
    EXPECT_NEAR(report.best.axis.max, 0.5, 1e-9);
    EXPECT_GT(report.error_max, 0.08);
    EXPECT_TRUE(mentions(report.findings, "all variances x 1.41"));
    EXPECT_TRUE(mentions(report.findings, "8-bit linear"));
    EXPECT_TRUE(mentions(report.findings, "its own convention says"));
    EXPECT_TRUE(mentions(report.advice, "dermis bake lut --profile gpu_gems_3 --axis curvature"));
}

TEST(Lint, the_difference_encoding_of_faceworks_is_recognised) {
    DERMIS_NEEDS(PNG);
    const TemporaryDirectory dir;
    ASSERT_TRUE(write_table(dir.path / "a.png", baked("faceworks"), TableStorage::u8));
    const LintReport report = *lint_file(dir.path / "a.png");
    EXPECT_EQ(report.best.integration, Integration::faceworks_taps);
    EXPECT_EQ(report.best.stored_as, StoredAs::difference);
    EXPECT_NEAR(report.best.axis.max, 1, 0.03);
    EXPECT_TRUE(report.explained);
}

TEST(Lint, a_turned_and_mirrored_srgb_picture_is_recognised) {
    Table table = baked("penner");
    for (int y = 0; y < table.height; ++y)  // the lit side first
        for (int x = 0; x < table.width / 2; ++x)
            for (int c = 0; c < 3; ++c) {
                const size_t row = size_t(y) * size_t(table.width);
                std::swap(table.data[3 * (row + size_t(x)) + size_t(c)],
                          table.data[3 * (row + size_t(table.width - 1 - x)) + size_t(c)]);
            }
    const Image image = picture_of(table, PixelFormat::u8, [](float v) { return srgb_encode(v); });
    const LintReport report = *lint_table(transposed(image));
    EXPECT_TRUE(report.best.transposed);
    EXPECT_TRUE(report.best.n_dot_l_mirrored);
    EXPECT_EQ(report.best.stored_as, StoredAs::srgb);
    EXPECT_EQ(report.best.how.construction, Construction::half_ring);
    EXPECT_TRUE(mentions(report.advice, "sRGB texture"));
    EXPECT_TRUE(mentions(report.advice, ", 0.5 - 0.5 * n_dot_l)"));
}

TEST(Lint, light_that_was_decoded_by_mistake_is_recognised) {
    const LintReport report =
        *lint_table(picture_of(baked("dermis"), PixelFormat::u16, [](float v) { return srgb_decode(v); }));
    EXPECT_EQ(report.best.stored_as, StoredAs::decoded_twice);
    EXPECT_EQ(report.best.how.construction, Construction::sphere);
}

TEST(Lint, another_profile_over_radius_is_recognised) {
    LutOptions lut = *lut_options("dermis");
    lut.width = lut.height = 32;
    lut.profile = *find_profile("jensen_skin2");
    lut.convention.axes[1] = radius_axis(2, 16);
    const LintReport report = *lint_table(picture_of(*bake_lut(lut), PixelFormat::f32, as_it_is));
    EXPECT_EQ(report.best.profile, "jensen_skin2");
    EXPECT_EQ(report.best.axis.name, "radius_mm");
    EXPECT_NEAR(report.best.axis.min, 2, 0.2);
    EXPECT_NEAR(report.best.axis.max, 16, 0.8);
    EXPECT_LT(report.error_max, 0.01);
}

TEST(Lint, its_sidecar_lets_a_table_without_a_convention_be_read) {
    DERMIS_NEEDS(PNG);
    const TemporaryDirectory dir;
    const auto path = dir.path / "ring.png";
    const Table table = baked("penner");
    ASSERT_TRUE(
        write_image(path, picture_of(table, PixelFormat::u8, [](float v) { return srgb_encode(v); })));
    ASSERT_FALSE(read_table(path, {})) << "it has no convention";
    const auto sidecar = write_sidecar(path, *lint_file(path));
    ASSERT_TRUE(sidecar) << sidecar.error().message;
    const auto read = read_table(path, {.kind = TableKind::diffuse,
                                        .construction = Construction::half_ring,
                                        .u_axis = "n_dot_l",
                                        .v_axis = table.convention.axes[1].name,
                                        .profile = "gpu_gems_3"});
    ASSERT_TRUE(read) << read.error().message;
    const TableAxis& axis = table.convention.axes[1];
    for (const double t : {-0.4, 0.0, 0.3, 0.9})
        for (const double s : {0.1, 0.5, 0.9}) {
            const double v = axis.min + s * (axis.max - axis.min);
            for (size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(lookup(*read, t, v)[c], lookup(table, t, v)[c], 0.01) << t << " " << v;
        }
    EXPECT_NE(write_sidecar(path, *lint_file(path)).error().message.find("has a convention already"),
              std::string::npos);
    const auto turned = dir.path / "turned.png";
    ASSERT_TRUE(write_image(turned, transposed(picture_of(table, PixelFormat::u8, as_it_is))));
    EXPECT_NE(write_sidecar(turned, *lint_file(turned)).error().message.find("turn it by 90 degrees"),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(sidecar_path(turned)));
}

TEST(Lint, says_the_range_of_the_file_it_reads_with_or_without_its_convention) {
    DERMIS_NEEDS(PNG);
    const TemporaryDirectory dir;
    for (const char* name : {"dermis", "penner", "unity_2011", "faceworks"})
        for (const char* profile : {"gpu_gems_3", "openpbr_skin_5"}) {
            LutOptions lut = *lut_options(name);
            lut.width = 64, lut.height = 32;
            lut.profile = *find_profile(profile);
            lut.profile.model = to_gaussian_sum(lut.profile).sum;
            const auto path = dir.path / (std::string(name) + profile + ".png");
            const Table table = *bake_lut(lut);
            ASSERT_TRUE(write_table(path, table, lut.storage));
            const Image picture = lint::read_picture(path)->image;
            for (const bool own : {true, false}) {
                // The encoding cuts so much of it that the sixth tone explains it as well.
                if (!own && lut.convention.encoding == TableEncoding::difference &&
                    lut.profile.name != "gpu_gems_3")
                    continue;
                const LintReport report = own ? *lint_file(path) : *lint_table(picture);
                EXPECT_TRUE(report.explained) << path;
                EXPECT_EQ(report.best.profile, profile);
                EXPECT_EQ(report.best.integration, lut.convention.integration);
                const TableAxis& axis = table.convention.axes[1];
                char text[64];
                std::snprintf(text, sizeof text, "curvature_per_mm %g to %g", axis.min, axis.max);
                EXPECT_TRUE(mentions(report.findings, text)) << own << describe(report.best);
                const auto convention = convention_of(report);
                ASSERT_TRUE(convention);
                EXPECT_NEAR(convention->axes[1].min, axis.min, 1e-9) << path;
                EXPECT_NEAR(convention->axes[1].max, axis.max, 1e-9) << path;
                EXPECT_EQ(convention->axes[1].sampling, axis.sampling);
                EXPECT_EQ(convention->v_origin, table.convention.v_origin);
            }
        }
}

TEST(Lint, rows_spaced_by_a_square_are_taken_from_the_files_convention) {
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    LutOptions lut = *lut_options("dermis");
    lut.width = 64, lut.height = 32;
    lut.convention.axes[1].warp = AxisWarp::squared;
    ASSERT_TRUE(write_table(dir.path / "a.exr", *bake_lut(lut)));
    const LintReport report = *lint_file(dir.path / "a.exr");
    EXPECT_LT(report.error_max, 1e-3);
    EXPECT_TRUE(mentions(report.findings, "curvature_per_mm 0 to 0.5, squared"));
    EXPECT_TRUE(mentions(report.advice, "sqrt(curvature_per_mm / 0.5)"));
}

namespace {

// Rows of the exact table at curvatures of a function of their place, 0 at the top of the picture to 1.
template <class Curvature>
Image table_of_rows(Curvature curvature, PixelFormat format, const char* profile = "gpu_gems_3") {
    constexpr int kWidth = 64, kHeight = 32;
    std::vector<double> n_dot_l, radii_mm;
    for (int x = 0; x < kWidth; ++x) n_dot_l.push_back((x + 0.5) / kWidth * 2 - 1);
    for (int y = 0; y < kHeight; ++y) radii_mm.push_back(1 / curvature((y + 0.5) / kHeight));
    const Profile skin = *find_profile(profile);
    const std::vector<float> light = *integrate_model(skin, Integration::exact, n_dot_l, radii_mm, {});
    Image image(kWidth, kHeight, 3);
    std::ranges::copy(light, image.floats().begin());
    return convert(image, format, Encoding::linear);
}

}  // namespace

TEST(Lint, rows_spaced_by_a_square_are_recognised_from_either_end) {
    DERMIS_NEEDS(EXR);
    for (const bool upwards : {false, true}) {
        const auto square = [&](double s) { return 0.5 * (upwards ? (1 - s) * (1 - s) : s * s); };
        const LintReport report = *lint_table(table_of_rows(square, PixelFormat::u8));
        EXPECT_TRUE(report.explained);
        EXPECT_EQ(report.best.axis.name, "curvature_per_mm");
        EXPECT_EQ(report.best.axis.warp, AxisWarp::squared);
        EXPECT_EQ(report.best.v_origin, upwards ? VOrigin::bottom : VOrigin::top);
        EXPECT_NEAR(report.best.axis.min, 0, 0.005);
        EXPECT_NEAR(report.best.axis.max, 0.5, 0.005);
        EXPECT_TRUE(mentions(report.findings, "curvature_per_mm 0 to 0.5, squared"));
        EXPECT_TRUE(mentions(report.advice,
                             upwards ? "1 - sqrt(curvature_per_mm / 0.5)" : "sqrt(curvature_per_mm / 0.5)"));
        EXPECT_TRUE(convention_of(report));
    }
}

TEST(Lint, rows_even_in_radius_or_in_its_root_are_recognised) {
    const LintReport even =
        *lint_table(table_of_rows([](double s) { return 1 / (1 + 19 * s); }, PixelFormat::f16));
    EXPECT_EQ(even.best.axis.name, "radius_mm");
    EXPECT_EQ(even.best.axis.warp, AxisWarp::linear);
    const LintReport root =
        *lint_table(table_of_rows([](double s) { return 1 / (1 + 19 * s * s); }, PixelFormat::f16));
    EXPECT_EQ(root.best.axis.name, "radius_mm");
    EXPECT_EQ(root.best.axis.warp, AxisWarp::squared);
    EXPECT_NEAR(root.best.axis.min, 1, 0.05);
    EXPECT_NEAR(root.best.axis.max, 20, 0.2);
}

TEST(Lint, rows_of_another_spacing_are_said_to_be) {
    const auto exponential = [](double s) { return 0.004 * std::pow(250, s); };
    const LintReport report = *lint_table(table_of_rows(exponential, PixelFormat::u8, "openpbr_skin_5"));
    EXPECT_FALSE(report.explained) << describe(report.best) << report.best.rms;
    EXPECT_TRUE(mentions(report.findings, "profile openpbr_skin_5"));
    EXPECT_TRUE(mentions(report.findings, "its rows are even neither in curvature or radius"));
    EXPECT_FALSE(mentions(report.findings, "no good match"));
    EXPECT_TRUE(mentions(report.advice, "--profile openpbr_skin_5"));
    EXPECT_FALSE(convention_of(report));
}

TEST(Lint, numbers_that_contradict_their_convention_are_named) {
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    Table table = baked("dermis");
    for (float& value : table.data) value = srgb_encode(value);
    ASSERT_TRUE(write_table(dir.path / "a.exr", table));
    const LintReport report = *lint_file(dir.path / "a.exr");
    EXPECT_EQ(report.best.stored_as, StoredAs::srgb);
    EXPECT_TRUE(mentions(report.findings, "its own convention does not describe these numbers"));
}

TEST(Lint, light_that_was_encoded_twice_is_named_and_gets_no_sidecar) {
    const TemporaryDirectory dir;
    const Image image =
        picture_of(baked("dermis"), PixelFormat::u8, [](float v) { return srgb_encode(srgb_encode(v)); });
    const LintReport report = *lint_table(image);
    EXPECT_EQ(report.best.stored_as, StoredAs::encoded_twice);
    EXPECT_EQ(report.best.profile, "gpu_gems_3");
    EXPECT_TRUE(mentions(report.findings, "encoded twice"));
    EXPECT_NE(convention_of(report).error().message.find("decode it once first"), std::string::npos);
}

TEST(Lint, a_picture_with_blue_first_is_named_and_gets_no_sidecar) {
    for (const char* name : {"dermis", "faceworks"}) {
        Table table = baked(name);
        for (size_t i = 0; i < table.data.size(); i += 3) std::swap(table.data[i], table.data[i + 2]);
        const LintReport report = *lint_table(picture_of(table, PixelFormat::f16, as_it_is));
        EXPECT_TRUE(report.best.bgr);
        EXPECT_EQ(report.best.profile, "gpu_gems_3");
        EXPECT_TRUE(mentions(report.advice, "swap red and blue"));
        EXPECT_NE(convention_of(report).error().message.find("swap red and blue"), std::string::npos);
    }
    EXPECT_FALSE(lint_table(picture_of(baked("dermis"), PixelFormat::f16, as_it_is))->best.bgr);
}

TEST(Lint, a_cropped_picture_is_named_with_what_is_left_of_it) {
    const Table table = baked("dermis", 128, 64);
    struct Crop {
        int x, y, width, height;
    };
    for (const Crop& crop : {Crop{64, 0, 64, 64}, {20, 16, 90, 40}}) {
        Image image(crop.width, crop.height, 3);
        for (int y = 0; y < crop.height; ++y)
            for (int x = 0; x < crop.width; ++x)
                for (int c = 0; c < 3; ++c) image.set(x, y, c, table.at(crop.x + x, crop.y + y, c));
        const LintReport report = *lint_table(image);
        EXPECT_TRUE(report.explained);
        EXPECT_EQ(report.best.profile, "gpu_gems_3") << describe(report.best);
        EXPECT_NEAR(report.best.n_dot_l_min, -1 + 2 * crop.x / 128.0, 0.02);
        EXPECT_NEAR(report.best.n_dot_l_max, -1 + 2 * (crop.x + crop.width) / 128.0, 0.02);
        EXPECT_NEAR(report.best.axis.min, 0.5 * crop.y / 64, 0.01);
        EXPECT_NEAR(report.best.axis.max, 0.5 * (crop.y + crop.height) / 64, 0.01);
        EXPECT_TRUE(mentions(report.findings, "cropped: it has N.L from"));
        EXPECT_EQ(mentions(report.findings, "cropped: nothing in it is flatter"), crop.y > 0);
    }
}

TEST(Lint, csv_is_read_with_and_without_its_convention) {
    const TemporaryDirectory dir;
    const auto path = dir.path / "a.csv";
    ASSERT_TRUE(write_table(path, baked("penner", 32, 16)));
    EXPECT_TRUE(mentions(lint_file(path)->findings, "its own convention says"));
    std::filesystem::remove(sidecar_path(path));
    const LintReport report = *lint_file(path);
    EXPECT_EQ(report.best.how.construction, Construction::half_ring);
    EXPECT_TRUE(
        mentions(report.findings, "n_dot_l -0.969 to 0.969 across, curvature_per_mm 0.0156 to 0.484 down"));
    ASSERT_TRUE(write_sidecar(path, report));
    EXPECT_TRUE(read_table(path, {.kind = TableKind::diffuse, .construction = Construction::half_ring}));
}

TEST(Lint, csv_that_is_no_grid_is_refused_with_its_line) {
    const auto refusal = [](std::string_view text) {
        return lint::parse_csv_picture(text, "a.csv").error().message;
    };
    EXPECT_EQ(refusal("x,y,r,g,b\n"), "a.csv:1: has no texels");
    EXPECT_NE(refusal("0,0,1,1,1\n1,0,1,1\n").find("a.csv:2: must be five numbers"), std::string::npos);
    EXPECT_NE(refusal("0,0,1,1,1\n1,0,1,1,1\n0,1,1,1,1\n").find("a.csv:3: the last row has 1"),
              std::string::npos);
    EXPECT_NE(refusal("0,0,1,1,1\n1,0,1,1,1\n0,1,1,1,1\n2,1,1,1,1\n").find("a.csv:4: its coordinates"),
              std::string::npos);
    EXPECT_NE(refusal("0,0,1,1,1\n1,0,1,1,inf\n").find("a.csv:2"), std::string::npos);
    EXPECT_EQ(lint::parse_csv_picture("0,0,1,2,3\n0,1,4,5,6\n", "a.csv")->image.at(1, 0, 2), 6);
}

// From the picture alone: the file's convention is not read.
TEST(Lint, every_table_that_bake_writes_is_named) {
    DERMIS_NEEDS(PNG);
    DERMIS_NEEDS(EXR);
    struct Case {
        const char* file;
        Table table;
        TableStorage storage = TableStorage::automatic;
        TableEncoding encoding = TableEncoding::linear;
    };
    const Profile skin = *find_profile("gpu_gems_3"), jensen = *find_profile("jensen_skin1");
    const Preintegration ring = {.construction = Construction::half_ring};
    Case cases[] = {
        {"gems.png", *bake_beckmann({.width = 64, .height = 64, .layout = BeckmannLayout::gems_8_bit}),
         TableStorage::u8, TableEncoding::tenth_power},
        {"beckmann.exr", *bake_beckmann({.width = 64, .height = 64})},
        {"zh.exr", *bake_zonal_harmonics({.profile = jensen})},
        {"zh.png",
         *bake_zonal_harmonics({.profile = skin, .how = ring, .layout = ZonalLayout::two_rows_remapped_8}),
         TableStorage::u8, TableEncoding::range},
        {"shadow.png", *bake_shadow({.profile = skin})},
        {"shadow_8.png", *bake_shadow({.profile = jensen, .sharpening = 5}), TableStorage::u8,
         TableEncoding::srgb},
    };
    const TemporaryDirectory directory;
    for (Case& one : cases) {
        SCOPED_TRACE(one.file);
        one.table.convention.encoding = one.encoding;
        const auto path = directory.path / one.file;
        ASSERT_TRUE(write_table(path, one.table, one.storage));
        const Result<LintReport> report = lint_table(read_image(path, ImageUse::data)->image);
        ASSERT_TRUE(report) << report.error().message;
        ASSERT_TRUE(report->explained && report->other);
        const Convention &found = *report->other, &made = one.table.convention;
        EXPECT_EQ(name_of(found.kind), name_of(made.kind));
        EXPECT_EQ(found.profile, made.profile);
        EXPECT_EQ(name_of(found.encoding), name_of(made.encoding));
        EXPECT_EQ(name_of(found.how.construction), name_of(made.how.construction));
        EXPECT_NEAR(found.shadow_sharpening, made.shadow_sharpening, 0.02 * made.shadow_sharpening);
        for (size_t i = 0; i < 2; ++i) {
            const double length = std::abs(made.axes[i].max - made.axes[i].min);
            EXPECT_NEAR(found.axes[i].min, made.axes[i].min, 0.01 * length) << i;
            EXPECT_NEAR(found.axes[i].max, made.axes[i].max, 0.01 * length) << i;
        }
    }
}

TEST(Lint, a_picture_that_is_not_a_table_is_reported) {
    Image image(32, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, float((x * 7 + y * 13 + c * 5) % 11) / 11);
    const LintReport report = *lint_table(image);
    EXPECT_FALSE(report.explained);
    EXPECT_TRUE(mentions(report.findings, "no table of skin: its light does not rise with N.L"));
}

TEST(Lint, pictures_that_cannot_be_tables_are_refused) {
    EXPECT_EQ(lint_table(Image(4, 4, 3)).error().message,
              "the picture is 4 x 4 texels; a table has at least 8 x 2");
    EXPECT_NE(lint_table(Image(16, 16, 1)).error().message.find("no colour"), std::string::npos);
    Image broken(16, 16, 3);
    broken.set(3, 3, 0, INFINITY);
    EXPECT_NE(lint_table(broken).error().message.find("not finite"), std::string::npos);
    EXPECT_NE(lint_file("/none.png").error().message.find("/none.png"), std::string::npos);
}

TEST(Lint, every_preset_can_be_a_model) {
    for (const std::string& name : profile_names())
        EXPECT_TRUE(check_preintegrable(*find_profile(name), {})) << name;
}
