// Pictures that are not tables of skin are refused, and the quality of a match is stated.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bake/lint_tables.h"
#include "dermis/bake/lint.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/table_io.h"
#include "dermis/image/io.h"
#include "dermis/optics/presets.h"
#include "support/temporary_directory.h"
#include "test_parts.h"

using namespace dermis;
using namespace dermis::test;

namespace {

// Texel x, y of a 64 x 32 picture: three numbers from functions of 0 to 1.
template <class Colour>
Image painted(Colour colour, PixelFormat format = PixelFormat::u8) {
    Image image(64, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const Vec3 texel = colour((float(x) + 0.5f) / 64, (float(y) + 0.5f) / 32);
            for (int c = 0; c < 3; ++c) image.set(x, y, c, c == 0 ? texel.x : c == 1 ? texel.y : texel.z);
        }
    return convert(image, format, Encoding::linear);
}

Vec3 grey(float value) {
    return {value, value, value};
}

// Between -1 and 1, without a pattern.
float noise(float x, float y) {
    const float wild = std::sin(x * 977.3f + y * 5711.9f) * 43758.5f;
    return 2 * (wild - std::floor(wild)) - 1;
}

}  // namespace

TEST(Lint, what_is_no_table_of_skin_is_said_to_be_none_and_gets_no_sidecar) {
    DERMIS_NEEDS(EXR);
    DERMIS_NEEDS(PNG);
    const TemporaryDirectory dir;
    // A ramp of one row, redder where it is darker: as on skin, but alike in all rows.
    const auto one_row = [](float u, float) {
        const float n_dot_l = 2 * u - 1;
        return Vec3{std::max(0.0f, 0.2f + 0.8f * n_dot_l), std::max(0.0f, 0.1f + 0.9f * n_dot_l),
                    std::max(0.0f, n_dot_l)};
    };
    const auto one_row_down = [&](float u, float v) { return one_row(v, u); };
    struct Case {
        Image image;
        std::string reason;
    };
    const Case cases[] = {
        {painted([](float, float) { return grey(0); }), "it is flat: all its numbers lie from 0 to 0"},
        {painted([](float, float) { return grey(1); }), "it is flat: all its numbers lie from 1 to 1"},
        {painted([](float, float) {
             return Vec3{0.5f, 0.49f, 0.48f};
         }),
         "it is flat"},
        {painted([](float u, float) { return grey(u); }), "it is grey"},
        {painted([](float, float v) { return grey(1 - v); }), "it is grey"},
        {painted([](float u, float) { return grey(std::max(0.0f, 2 * u - 1)); }), "it is grey"},
        {painted([](float u, float v) { return grey(u * v); }), "it is grey"},
        {painted([](float u, float v) { return grey(-0.01f + 0.01f * noise(u, v)); }, PixelFormat::f32),
         "it has negative numbers, down to -0.0"},
        {painted(one_row), "its rows are alike"},
        {painted(one_row_down, PixelFormat::f16), "its rows are alike"},
        {painted([](float u, float v) {
             return Vec3{std::abs(std::sin(9 * u)), std::abs(std::sin(7 * v)), std::abs(std::cos(8 * u))};
         }),
         "its light does not rise with N.L: it falls by "}};
    int number = 0;
    for (const Case& c : cases) {
        const auto path =
            dir.path / (std::to_string(number++) + (c.image.format == PixelFormat::u8 ? ".png" : ".exr"));
        ASSERT_TRUE(write_image(path, c.image));
        const Result<LintReport> report = lint_file(path);
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_FALSE(report->explained) << number;
        EXPECT_TRUE(report->refusal.starts_with(c.reason)) << number << ": " << report->refusal;
        EXPECT_TRUE(mentions(report->findings, "no table of skin: " + c.reason)) << number;
        EXPECT_FALSE(mentions(report->advice, "exact table"));
        const auto sidecar = write_sidecar(path, *report);
        ASSERT_FALSE(sidecar);
        EXPECT_NE(sidecar.error().message.find("no table of skin: "), std::string::npos);
        EXPECT_FALSE(std::filesystem::exists(sidecar_path(path)));
        for (const std::string& line : report->advice)
            EXPECT_TRUE(line.find("/ 0)") == line.npos && line.find("/ 0,") == line.npos) << line;
    }
}

TEST(Lint, a_convention_beside_it_makes_a_black_picture_no_table) {
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    Table table = baked("dermis");
    table.convention.axes[0].max = -0.05;
    std::ranges::fill(table.data, 0.0f);
    ASSERT_TRUE(write_table(dir.path / "black.exr", table));
    const Result<LintReport> report = lint_file(dir.path / "black.exr");
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->refusal.starts_with("it is flat")) << report->refusal;
}

TEST(Lint, its_own_convention_lets_a_table_be_grey_and_its_rows_be_alike) {
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    LutOptions lut = *lut_options("dermis");
    lut.width = 64, lut.height = 16;
    lut.profile = *find_profile("burley:1,1,1");
    lut.convention.axes[1] = curvature_axis(0, 0.002);
    const Table table = *bake_lut(lut);
    ASSERT_TRUE(write_table(dir.path / "a.exr", table));
    const Result<LintReport> report = lint_file(dir.path / "a.exr");
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->explained) << report->refusal;
    EXPECT_TRUE(lint_table(picture_of(table, PixelFormat::f32, as_it_is))->refusal.starts_with("it is grey"));
}

TEST(Lint, how_much_is_explained_is_stated) {
    const LintReport exact = *lint_table(picture_of(baked("dermis"), PixelFormat::f16, as_it_is));
    EXPECT_GT(exact.explained_share, 0.9999);
    EXPECT_TRUE(
        mentions(exact.findings, "more than 99.99 % of how its rows and colours differ is explained"));
    EXPECT_FALSE(mentions(exact.findings, "do not tell it from the best"));
    const LintReport unity = *lint_table(picture_of(baked("unity_2011"), PixelFormat::u8, as_it_is));
    EXPECT_GT(unity.explained_share, 0.99);
}

TEST(Lint, numbers_of_another_kind_than_their_convention_are_named) {
    DERMIS_NEEDS(EXR);
    const TemporaryDirectory dir;
    Table table = baked("dermis", 64, 3);
    table.convention.kind = TableKind::shadow;
    table.convention.axes = {TableAxis{.name = "penumbra_position", .unit = "1"},
                             TableAxis{.name = "penumbra_width_mm", .unit = "mm", .min = 1, .max = 40}};
    ASSERT_TRUE(write_table(dir.path / "shadow.exr", table));
    const Result<LintReport> report = lint_file(dir.path / "shadow.exr");
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(mentions(report->findings, "its own convention says: 64 x 3 shadow"));
    EXPECT_TRUE(mentions(report->findings, "its own convention does not describe these numbers"));
}
