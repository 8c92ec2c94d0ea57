#include "dermis/image/resample.h"

#include <gtest/gtest.h>

#include "dermis/image/colour.h"
#include "image/test_images.h"

using namespace dermis;

namespace {

double mean(const Image& image, int channel) {
    const Image linear = to_linear_float(image);
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += linear.at(x, y, channel);
    return sum / double(image.pixel_count());
}

Image checkerboard(int side, PixelFormat format, Encoding encoding) {
    Image image(side, side, 3);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, float((x + y) % 2));
    return convert(image, format, encoding);
}

}  // namespace

TEST(Resize, shrinking_keeps_the_mean_for_any_ratio) {
    const Image image = test_pattern(45, 31, 2);
    for (const auto& [width, height] : {std::pair{1, 1}, {9, 31}, {22, 15}, {44, 30}, {7, 2}}) {
        const Image small = resize(image, width, height);
        for (int c = 0; c < 2; ++c) EXPECT_NEAR(mean(small, c), mean(image, c), 2e-6);
    }
}

TEST(Resize, averages_light_and_not_srgb_codes) {
    for (const PixelFormat format : {PixelFormat::u8, PixelFormat::u16}) {
        const Image small = resize(checkerboard(8, format, Encoding::srgb), 4, 4);
        EXPECT_EQ(small.encoding, Encoding::srgb);
        EXPECT_NEAR(small.at(2, 1, 0), srgb_encode(0.5f), 0.002f);
    }
    EXPECT_NEAR(resize(checkerboard(8, PixelFormat::f16, Encoding::linear), 2, 2).at(0, 0, 0), 0.5f, 1e-6f);
}

TEST(Resize, growing_interpolates_between_centres_and_keeps_a_ramp) {
    Image ramp(8, 2, 1);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 8; ++x) ramp.set(x, y, 0, float(x) + 0.5f);
    const Image large = resize(ramp, 32, 5);
    for (int x = 2; x < 30; ++x) EXPECT_NEAR(large.at(x, 3, 0), (float(x) + 0.5f) / 4.0f, 1e-5f);
    EXPECT_EQ(large.at(0, 0, 0), 0.5f);
    EXPECT_EQ(large.at(31, 4, 0), 7.5f);
    EXPECT_EQ(resize(Image(1, 1, 3), 5, 5).width, 5);
}

TEST(Resize, unit_vectors_stay_unit_in_codes_and_in_floats) {
    Image vectors(2, 1, 3);
    const Vec3 n[2] = {{0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}};
    for (int x = 0; x < 2; ++x) {
        vectors.set(x, 0, 0, n[x].x);
        vectors.set(x, 0, 1, n[x].y);
        vectors.set(x, 0, 2, n[x].z);
    }
    EXPECT_NEAR(resize(vectors, 1, 1, Texels::values).at(0, 0, 2), 0.8f, 1e-6f);
    EXPECT_NEAR(resize(vectors, 1, 1, Texels::unit_vectors).at(0, 0, 2), 1.0f, 1e-6f);

    Image codes(2, 1, 3, PixelFormat::u8);
    for (int x = 0; x < 2; ++x)
        for (int c = 0; c < 3; ++c) codes.set(x, 0, c, vectors.at(x, 0, c) * 0.5f + 0.5f);
    const Image one = resize(codes, 1, 1, Texels::unit_vectors);
    EXPECT_NEAR(one.at(0, 0, 0), 0.5f, 0.003f);
    EXPECT_NEAR(one.at(0, 0, 1), 0.5f, 0.003f);
    EXPECT_NEAR(one.at(0, 0, 2), 1.0f, 0.003f);
}

TEST(Resize, opposite_unit_vectors_do_not_make_nan) {
    Image vectors(2, 1, 3);
    vectors.set(0, 0, 0, 1);
    vectors.set(1, 0, 0, -1);
    EXPECT_EQ(resize(vectors, 1, 1, Texels::unit_vectors).at(0, 0, 0), 0.0f);
}

TEST(MipChain, halves_down_to_one_texel_that_is_the_mean) {
    const Image image = convert(test_pattern(40, 12, 3), PixelFormat::f16, Encoding::linear);
    const std::vector<Image> levels = mip_chain(image);
    ASSERT_EQ(levels.size(), 6u);
    EXPECT_EQ(levels[0].bytes, image.bytes);
    EXPECT_EQ(levels[2].width, 10);
    EXPECT_EQ(levels[2].height, 3);
    EXPECT_EQ(levels[5].width, 1);
    EXPECT_EQ(levels[5].height, 1);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(levels[5].at(0, 0, c), mean(image, c), 1e-3);
}

TEST(MipChain, a_checkerboard_in_srgb_keeps_its_light_to_the_last_level) {
    const std::vector<Image> levels = mip_chain(checkerboard(64, PixelFormat::u8, Encoding::srgb));
    for (size_t i = 1; i < levels.size(); ++i) EXPECT_NEAR(mean(levels[i], 1), 0.5, 0.004);
}

TEST(SampleBilinear, is_exact_at_centres_and_linear_between) {
    const Image image = test_pattern(5, 4, 3);
    const auto centre = [](int x, int y) { return Vec2{(float(x) + 0.5f) / 5, (float(y) + 0.5f) / 4}; };
    EXPECT_NEAR(sample_bilinear(image, centre(3, 2)).y, image.at(3, 2, 1), 1e-6f);
    EXPECT_EQ(sample_bilinear(image, centre(3, 2)).w, 1.0f);
    const Vec2 between = (centre(1, 1) + centre(2, 1)) * 0.5f;
    EXPECT_NEAR(sample_bilinear(image, between).x, 0.5f * (image.at(1, 1, 0) + image.at(2, 1, 0)), 1e-6f);
}

TEST(SampleBilinear, clamps_outside) {
    const Image image = test_pattern(4, 4, 1);
    EXPECT_NEAR(sample_bilinear(image, {-7.0f, 0.125f}).x, image.at(0, 0, 0), 1e-6f);
    EXPECT_NEAR(sample_bilinear(image, {1e30f, 0.125f}).x, image.at(3, 0, 0), 1e-6f);
    EXPECT_EQ(sample_bilinear(image, {0.3f, 0.3f}).x, sample_bilinear(image, {0.3f, 0.3f}).z);
}
