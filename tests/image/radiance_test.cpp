#include <gtest/gtest.h>

#include "dermis/image/io.h"
#include "image/test_files.h"
#include "image/test_images.h"

using namespace dermis;

namespace {

FileBytes file_of(std::string_view header, const std::vector<int>& texels) {
    FileBytes file;
    for (const char c : header) file.push_back(std::byte(c));
    for (const int value : texels) file.push_back(std::byte(value));
    return file;
}

Result<LoadedImage> decode_radiance(const FileBytes& file) {
    return decode_image(file, "test.hdr", ImageUse::color);
}

constexpr std::string_view kHeader = "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n";

}  // namespace

TEST(Radiance, flat_texels_decode_mantissa_and_exponent) {
    const FileBytes file = file_of(std::string(kHeader) + "-Y 1 +X 2\n", {128, 64, 0, 129, 0, 0, 200, 136});
    const Result<LoadedImage> loaded = decode_radiance(file);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->image.at(0, 0, 0), 1.0f);
    EXPECT_EQ(loaded->image.at(0, 0, 1), 0.5f);
    EXPECT_EQ(loaded->image.at(1, 0, 2), 200.0f);
}

TEST(Radiance, the_oldest_repeat_code_repeats_the_texel_before) {
    const FileBytes file = file_of(std::string(kHeader) + "-Y 1 +X 4\n", {128, 0, 0, 129, 1, 1, 1, 3});
    const Result<LoadedImage> loaded = decode_radiance(file);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->image.at(3, 0, 0), 1.0f);
    EXPECT_FALSE(
        decode_radiance(file_of(std::string(kHeader) + "-Y 1 +X 4\n", {128, 0, 0, 129, 1, 1, 1, 4})));
    EXPECT_FALSE(decode_radiance(file_of(std::string(kHeader) + "-Y 1 +X 4\n", {1, 1, 1, 4})));
}

TEST(Radiance, signs_of_the_resolution_line_flip) {
    const std::vector<int> texels = {128, 0, 0, 129, 0, 128, 0, 129, 0, 0, 128, 129, 0, 0, 0, 0};
    const Result<LoadedImage> plain = decode_radiance(file_of(std::string(kHeader) + "-Y 2 +X 2\n", texels));
    const Result<LoadedImage> flipped =
        decode_radiance(file_of(std::string(kHeader) + "+Y 2 -X 2\n", texels));
    ASSERT_TRUE(plain);
    ASSERT_TRUE(flipped);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(plain->image.at(x, y, c), flipped->image.at(1 - x, 1 - y, c));
}

TEST(Radiance, what_is_written_reads_back_within_the_shared_exponent) {
    for (const int width : {5, 64, 300}) {
        Image image = test_pattern(width, 9, 3);
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, 4, c, 250.0f);  // runs
        const Result<FileBytes> file = encode_image(".hdr", image);
        const Result<LoadedImage> loaded = decode_radiance(*file);
        ASSERT_TRUE(loaded) << loaded.error().message;
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(loaded->image.at(x, y, c), image.at(x, y, c), y == 4 ? 0.0f : 1.0f / 256.0f);
    }
}

TEST(Radiance, values_that_rgbe_has_no_code_for_are_written_as_the_nearest) {
    Image image(1, 1, 3);
    image.set(0, 0, 0, -1.0f);
    image.set(0, 0, 1, NAN);
    image.set(0, 0, 2, HUGE_VALF);
    const Image back = decode_radiance(*encode_image(".hdr", image))->image;
    EXPECT_EQ(back.at(0, 0, 0), 0.0f);
    EXPECT_EQ(back.at(0, 0, 1), 0.0f);
    EXPECT_GT(back.at(0, 0, 2), 1e38f);
}

TEST(Radiance, wrong_headers_are_named) {
    for (const char* line :
         {"+X 2 -Y 2\n", "-Y 0 +X 2\n", "-Y 2.5 +X 2\n", "-Y 2 +X 99999\n", "-Y nan +X 2\n", "\n"}) {
        const Result<LoadedImage> loaded =
            decode_radiance(file_of(std::string(kHeader) + line, std::vector<int>(16, 0)));
        EXPECT_FALSE(loaded) << line;
    }
    EXPECT_FALSE(decode_radiance(file_of("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", {0, 0, 0, 0})));
    EXPECT_FALSE(decode_radiance(file_of("#?RADIANCE\n\n-Y 1 +X 1\n", {0, 0, 0, 0})));
}
