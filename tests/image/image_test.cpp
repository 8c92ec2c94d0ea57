#include "dermis/image/image.h"

#include <gtest/gtest.h>
#include <half.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "dermis/image/colour.h"
#include "dermis/image/half.h"
#include "image/test_images.h"

using namespace dermis;

TEST(Half, every_code_round_trips_through_float) {
    for (uint32_t code = 0; code <= 0xffff; ++code) {
        const float value = from_half(uint16_t(code));
        if (std::isnan(value)) {
            EXPECT_TRUE((code & 0x7c00) == 0x7c00 && (code & 0x3ff) != 0) << code;
            EXPECT_TRUE(std::isnan(from_half(to_half(value))));
        } else {
            EXPECT_EQ(to_half(value), code);
        }
    }
}

TEST(Half, agrees_with_imath_on_values_codes_and_ties) {
    for (uint32_t code = 0; code < 0x7bff; ++code) {
        Imath::half low, high;
        low.setBits(uint16_t(code));
        high.setBits(uint16_t(code + 1));
        ASSERT_EQ(from_half(uint16_t(code)), float(low));
        const float middle = 0.5f * (float(low) + float(high));
        for (const float value :
             {middle, std::nextafter(middle, 0.0f), std::nextafter(middle, 1e9f), -middle})
            ASSERT_EQ(to_half(value), Imath::half(value).bits()) << value;
    }
}

TEST(Half, finite_values_saturate_and_infinity_stays) {
    EXPECT_EQ(from_half(to_half(1e9f)), kMaxHalf);
    EXPECT_EQ(from_half(to_half(-65519.0f)), -kMaxHalf);
    EXPECT_EQ(from_half(to_half(HUGE_VALF)), HUGE_VALF);
}

TEST(Image, every_8_bit_srgb_code_round_trips_through_linear_light) {
    Image codes(256, 1, 3, PixelFormat::u8, Encoding::srgb);
    for (size_t i = 0; i < codes.bytes.size(); ++i) codes.bytes[i] = std::byte(i / 3);
    EXPECT_EQ(convert(to_linear_float(codes), PixelFormat::u8, Encoding::srgb).bytes, codes.bytes);
}

TEST(Image, every_16_bit_code_round_trips_in_both_encodings) {
    for (const Encoding encoding : {Encoding::linear, Encoding::srgb}) {
        Image codes(256, 256, 1, PixelFormat::u16, encoding);
        for (size_t i = 0; i < 65536; ++i) codes.values<uint16_t>()[i] = uint16_t(i);
        EXPECT_EQ(convert(to_linear_float(codes), PixelFormat::u16, encoding).bytes, codes.bytes);
    }
}

TEST(Image, eight_bit_srgb_rounds_to_the_nearest_code) {
    Image ramp(4096, 1, 1);
    for (int x = 0; x < 4096; ++x) ramp.set(x, 0, 0, float(x) / 4095.0f);
    const Image codes = convert(ramp, PixelFormat::u8, Encoding::srgb);
    for (int x = 0; x < 4096; ++x) {
        const float exact = srgb_encode(float(x) / 4095.0f) * 255.0f;
        EXPECT_NEAR(float(codes.values<uint8_t>()[size_t(x)]), exact, 0.5001f) << x;
    }
}

TEST(Image, alpha_is_never_srgb_encoded) {
    Image image(1, 1, 4);
    for (int c = 0; c < 4; ++c) image.set(0, 0, c, 0.5f);
    for (const PixelFormat format : {PixelFormat::u8, PixelFormat::u16, PixelFormat::f16, PixelFormat::f32}) {
        const Image encoded = convert(image, format, Encoding::srgb);
        EXPECT_NEAR(encoded.at(0, 0, 0), 0.7354f, 2e-3f);
        EXPECT_NEAR(encoded.at(0, 0, 3), 0.5f, 2e-3f);
        EXPECT_LT(largest_difference(encoded, image), 4e-3f);
    }
}

TEST(Image, integers_clamp_and_nan_becomes_zero) {
    Image image(3, 1, 1);
    image.set(0, 0, 0, -1);
    image.set(1, 0, 0, 7);
    image.set(2, 0, 0, std::numeric_limits<float>::quiet_NaN());
    for (const Encoding encoding : {Encoding::linear, Encoding::srgb})
        for (const PixelFormat format : {PixelFormat::u8, PixelFormat::u16}) {
            const Image out = convert(image, format, encoding);
            EXPECT_EQ(out.at(0, 0, 0), 0.0f);
            EXPECT_EQ(out.at(1, 0, 0), 1.0f);
            EXPECT_EQ(out.at(2, 0, 0), 0.0f);
        }
}

TEST(Image, a_new_image_is_zero_and_an_empty_one_converts_to_an_empty_one) {
    EXPECT_EQ(Image(2, 2, 3).at(1, 1, 2), 0.0f);
    EXPECT_TRUE(Image().empty());
    EXPECT_TRUE(to_linear_float(Image()).empty());
    EXPECT_TRUE(convert(Image(), PixelFormat::u8, Encoding::srgb).empty());
}

TEST(Image, sizes_beyond_the_limits_are_refused) {
    EXPECT_TRUE(check_image_size(16384, 16384, 2));
    EXPECT_TRUE(check_image_size(1, 1, 1));
    EXPECT_FALSE(check_image_size(0, 5, 3));
    EXPECT_NE(check_image_size(16385, 1, 3).error().message.find("16384"), std::string::npos);
    EXPECT_FALSE(check_image_size(uint64_t{1} << 63, 2, 4));
    EXPECT_EQ(check_image_size(16384, 16384, 4).error().message,
              "holds 16384 x 16384 texels of 4 channels, 4096 MiB as floats; the limit is 2048 "
              "(DERMIS_MAX_IMAGE_MIB)");
}

TEST(ImageSize, the_limit_on_memory_is_adjustable) {
    ::setenv("DERMIS_MAX_IMAGE_MIB", "4096", 1);
    EXPECT_TRUE(check_image_size(16384, 16384, 4));
    ::setenv("DERMIS_MAX_IMAGE_MIB", "1", 1);
    EXPECT_TRUE(check_image_size(512, 512, 1));
    EXPECT_FALSE(check_image_size(512, 513, 1));
    for (const char* wrong : {"", "0", "-1", "nan", "inf", "1 GiB", "1e300"}) {
        ::setenv("DERMIS_MAX_IMAGE_MIB", wrong, 1);
        const Result<void> size = check_image_size(1, 1, 1);
        ASSERT_FALSE(size) << wrong;
        EXPECT_NE(size.error().message.find("DERMIS_MAX_IMAGE_MIB"), std::string::npos);
    }
    ::unsetenv("DERMIS_MAX_IMAGE_MIB");
}
