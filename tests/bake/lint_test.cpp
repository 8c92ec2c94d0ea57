// Tables of each convention are recognised after they were rotated, wrongly encoded and stored as files.

#include "dermis/bake/lint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dermis/bake/lut.h"
#include "dermis/bake/rows.h"
#include "dermis/bake/table_io.h"
#include "dermis/image/colour.h"
#include "dermis/image/io.h"
#include "dermis/optics/presets.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

Table baked(std::string_view convention, int width = 64, int height = 32) {
    LutOptions lut = *lut_options(convention);
    lut.width = width;
    lut.height = height;
    return *bake_lut(lut);
}

// Saved as by a tool without conventions, with `change` applied to the decoded values.
template <class Change>
Image picture_of(const Table& table, PixelFormat format, Change change) {
    Image image(table.width, table.height, 3);
    for (size_t i = 0; i < table.data.size(); ++i) image.floats()[i] = change(table.data[i]);
    return convert(image, format, Encoding::linear);
}

float as_it_is(float value) {
    return value;
}

Image transposed(const Image& image) {
    Image turned(image.height, image.width, 3, image.format);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) turned.set(y, x, c, image.at(x, y, c));
    return turned;
}

bool mentions(const std::vector<std::string>& lines, std::string_view text) {
    return std::ranges::any_of(lines,
                               [&](const std::string& line) { return line.find(text) != std::string::npos; });
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
    const TemporaryDirectory dir;
    ASSERT_TRUE(write_table(dir.path / "a.png", baked("unity_2011"), TableStorage::u8));
    const LintReport report = *lint_file(dir.path / "a.png");
    EXPECT_EQ(report.best.integration, Integration::unity_taps);
    EXPECT_EQ(report.best.sampling, TexelSampling::low_edge);
    EXPECT_FALSE(report.best.transposed || report.best.n_dot_l_mirrored);
    // Bottom up, and variances x 1.414 are curvatures x 1.189.
    EXPECT_NEAR(report.best.axis.min, 0.5 * std::sqrt(1.414), 0.02);
    EXPECT_NEAR(report.best.axis.max, 0, 0.02);
    EXPECT_GT(report.error_max, 0.08);
    EXPECT_TRUE(mentions(report.findings, "variances x 1.414"));
    EXPECT_TRUE(mentions(report.findings, "8-bit linear"));
    EXPECT_TRUE(mentions(report.findings, "its own convention says"));
    EXPECT_TRUE(mentions(report.advice, "dermis bake lut --profile gpu_gems_3 --axis curvature"));
}

TEST(Lint, the_difference_encoding_of_faceworks_is_recognised) {
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

TEST(Lint, a_picture_that_is_not_a_table_is_reported) {
    Image image(32, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, float((x * 7 + y * 13 + c * 5) % 11) / 11);
    const LintReport report = *lint_table(image);
    EXPECT_FALSE(report.explained);
    EXPECT_TRUE(mentions(report.findings, "no good match"));
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
