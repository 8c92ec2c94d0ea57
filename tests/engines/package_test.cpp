// What every engine's package must be: the same bytes every time, a table that says the skin's light where
// the engine reads it, no word left to replace.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dermis/base/file.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/preintegration.h"
#include "dermis/shading/skin_text.h"
#include "engines/packages.h"

namespace dermis {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Packages, are_the_same_bytes_every_time_and_others_for_another_skin) {
    for (const std::string& engine : engine_names()) {
        const auto once = package_of(engine, "openpbr_skin_5"), twice = package_of(engine, "openpbr_skin_5"),
                   other = package_of(engine, "openpbr_skin_1");
        ASSERT_EQ(once.size(), twice.size()) << engine;
        EXPECT_EQ(once, twice) << engine;
        EXPECT_NE(once, other) << engine;
    }
}

TEST(Packages, hold_a_readme_a_licence_and_no_word_left_to_replace) {
    for (const std::string& engine : engine_names()) {
        const auto files = package_of(engine, "openpbr_skin_5");
        EXPECT_EQ(files.count("README.md"), 1u) << engine;
        size_t licences = 0;
        for (const auto& [path, text] : files) {
            licences += text.starts_with("MIT License");
            if (path.ends_with(".exr") || path.ends_with(".dds") || path.ends_with(".png")) continue;
            EXPECT_THAT(text, Not(testing::ContainsRegex("@[a-z_]+@"))) << engine << ": " << path;
            EXPECT_TRUE(text.ends_with('\n')) << engine << ": " << path;
        }
        EXPECT_EQ(licences, 1u) << engine;
        EXPECT_THAT(files.at("README.md"), HasSubstr("openpbr_skin_5")) << engine;
    }
}

// A texture filtered with linear, clamped coordinates, v = 0 at the top of the picture.
Rgb sample(const Image& image, double u, double v) {
    const auto at = [&](double x, double y, size_t c) {
        const int column = std::clamp(int(x), 0, image.width - 1),
                  row = std::clamp(int(y), 0, image.height - 1);
        return double(image.at(column, row, int(c)));
    };
    const double x = u * image.width - 0.5, y = v * image.height - 0.5;
    const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
    Rgb value;
    for (size_t c = 0; c < 3; ++c)
        value[c] = (1 - fy) * ((1 - fx) * at(x0, y0, c) + fx * at(x0 + 1, y0, c)) +
                   fy * ((1 - fx) * at(x0, y0 + 1, c) + fx * at(x0 + 1, y0 + 1, c));
    return value;
}

// Read as the engine reads it, at the coordinates of skin_diffuse_coordinate(). Unity, three.js and
// Babylon.js have v = 0 at the bottom.
TEST(Packages, tables_give_the_light_of_the_skin) {
    const auto skin = find_profile("openpbr_skin_5");
    ASSERT_TRUE(skin);
    const GaussianSum gaussians = to_gaussian_sum(*skin).sum;
    for (const std::string& engine : engine_names()) {
        const bool from_bottom = engine == "unity" || engine == "three";
        for (const auto& [path, bytes] : package_of(engine, "openpbr_skin_5")) {
            if (!path.ends_with(".exr") && !path.ends_with(".dds")) continue;
            const auto table = decode_image(as_bytes(bytes), path, ImageUse::data);
            ASSERT_TRUE(table) << path;
            for (const double k : {0.02, 0.125, 0.5})
                for (const double n_dot_l : {-0.4, 0.0, 0.3, 0.9}) {
                    const Rgb exact = preintegrated_diffuse(gaussians, n_dot_l, 1 / k, {});
                    const Rgb read = sample(table->image, n_dot_l * 0.5 + 0.5, from_bottom ? 1 - k : k);
                    for (size_t c = 0; c < 3; ++c)
                        EXPECT_NEAR(read[c], exact[c], 0.002) << engine << " " << n_dot_l << " " << k;
                }
        }
    }
}

TEST(Packages, refuse_an_unknown_engine_with_the_closest) {
    const auto refused = check_engine("godott");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("did you mean 'godot'?"));
}

TEST(Packages, name_the_file_of_an_unknown_word) {
    const std::vector<PackageTemplate> templates = {{"engines/godot/a.txt", "by @nobody@\n"}};
    const auto refused =
        make_package("godot", {*find_profile("gpu_gems_3"), shading::skin_sources(), templates});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "engines/godot/a.txt: unknown word 'nobody'");
}

}  // namespace
}  // namespace dermis
