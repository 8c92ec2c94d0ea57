// Tests of the comparator of golden pictures itself.

#include "support/golden.h"

#include <gtest/gtest.h>

#include "image/test_images.h"
#include "support/temporary_directory.h"

namespace fs = std::filesystem;
using namespace dermis;

namespace {

struct Golden : testing::Test {
    TemporaryDirectory dir;
    GoldenPlace place{dir.path / "goldens", dir.path / "failures"};
    Image picture = test_pattern(40, 30, 3);

    void SetUp() override {
        ::unsetenv("DERMIS_UPDATE_GOLDENS");
        ASSERT_TRUE(write_image(place.goldens / "a.png", picture));
    }
    void TearDown() override { ::unsetenv("DERMIS_UPDATE_GOLDENS"); }
};

}  // namespace

TEST_F(Golden, the_same_picture_and_one_off_by_rounding_match) {
    EXPECT_TRUE(matches_golden(picture, "a", {}, place));
    Image rounded = convert(picture, PixelFormat::u8, Encoding::srgb);
    for (size_t i = 0; i < rounded.bytes.size(); i += 3) rounded.values<uint8_t>()[i] ^= 1;
    EXPECT_TRUE(matches_golden(rounded, "a", {}, place));
    EXPECT_FALSE(fs::exists(place.failures));
}

TEST_F(Golden, a_shifted_tone_fails_and_leaves_three_pictures) {
    for (float& value : picture.floats()) value *= 0.98f;
    const testing::AssertionResult result = matches_golden(picture, "a", {}, place);
    ASSERT_FALSE(result);
    for (const char* what : {"new", "old", "difference"}) {
        const fs::path path = place.failures / ("a." + std::string(what) + ".png");
        EXPECT_TRUE(read_image(path, ImageUse::color)) << path;
        EXPECT_NE(std::string(result.message()).find(path.string()), std::string::npos) << result.message();
    }
}

TEST_F(Golden, a_small_patch_fails_as_outliers_though_the_mean_is_small) {
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) picture.set(x, y, 1, picture.at(x, y, 1) > 0.5f ? 0.1f : 0.9f);
    EXPECT_FALSE(matches_golden(picture, "a", {.mean_codes = 255}, place));
    EXPECT_TRUE(matches_golden(picture, "a", {.mean_codes = 255, .outlier_share = 0.01}, place));
}

TEST_F(Golden, a_missing_golden_and_another_size_fail) {
    EXPECT_FALSE(matches_golden(picture, "b", {}, place));
    EXPECT_TRUE(fs::exists(place.failures / "b.new.png"));
    EXPECT_FALSE(matches_golden(test_pattern(41, 30, 3), "a", {}, place));
}

TEST_F(Golden, updating_rewrites_the_golden) {
    for (float& value : picture.floats()) value *= 0.5f;
    ASSERT_FALSE(matches_golden(picture, "a", {}, place));
    ::setenv("DERMIS_UPDATE_GOLDENS", "1", 1);
    ASSERT_TRUE(matches_golden(picture, "a", {}, place));
    ::unsetenv("DERMIS_UPDATE_GOLDENS");
    EXPECT_TRUE(matches_golden(picture, "a", {}, place));
}

TEST_F(Golden, those_that_are_missing_can_be_made_without_touching_the_others) {
    ::setenv("DERMIS_UPDATE_GOLDENS", "missing", 1);
    EXPECT_TRUE(matches_golden(picture, "b", {}, place));
    for (float& value : picture.floats()) value *= 0.5f;
    EXPECT_FALSE(matches_golden(picture, "a", {}, place));
    EXPECT_FALSE(matches_golden(picture, "b", {}, place));
}
