#include <gtest/gtest.h>

#include "dermis/image/io.h"
#include "image/test_files.h"
#include "image/test_images.h"

using namespace dermis;

namespace {

Image smooth(int channels) {
    Image image(64, 40, channels);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < channels; ++c)
                image.set(x, y, c, 0.1f + 0.8f * float(x + c * y) / float(64 + 40 * channels));
    return image;
}

}  // namespace

TEST(Jpeg, grey_and_rgb_baseline_and_progressive_read_as_8_bit_srgb) {
    for (const int channels : {1, 3})
        for (const bool progressive : {false, true}) {
            const Image image = smooth(channels);
            const Result<LoadedImage> loaded =
                decode_image(make_jpeg(image, 97, progressive), "test.jpg", ImageUse::color);
            ASSERT_TRUE(loaded) << loaded.error().message;
            EXPECT_EQ(loaded->image.format, PixelFormat::u8);
            EXPECT_EQ(loaded->image.encoding, Encoding::srgb);
            EXPECT_LT(largest_difference(loaded->image, image), 0.02f);
        }
}

TEST(Jpeg, data_is_linear) {
    const Result<LoadedImage> loaded = decode_image(make_jpeg(smooth(1), 90, false), "n.jpg", ImageUse::data);
    EXPECT_EQ(loaded->image.encoding, Encoding::linear);
}

TEST(Jpeg, cmyk_is_refused_by_name) {
    const Result<LoadedImage> loaded = decode_image(make_cmyk_jpeg(16, 16), "print.jpg", ImageUse::color);
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().message, "print.jpg: CMYK JPEG; dermis reads grey and RGB");
}

TEST(Jpeg, a_small_file_that_states_a_huge_size_is_refused_before_decoding) {
    FileBytes file = make_jpeg(smooth(3), 90, false);
    // The frame header FF C0 holds the height two bytes after its length and precision.
    for (size_t i = 0; i + 9 < file.size(); ++i)
        if (file[i] == std::byte{0xff} && file[i + 1] == std::byte{0xc0}) {
            file[i + 5] = file[i + 7] = std::byte{0x2f};
            break;
        }
    const Result<LoadedImage> loaded = decode_image(file, "bomb.jpg", ImageUse::color);
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message.find("too short a file"), std::string::npos) << loaded.error().message;
}

TEST(Jpeg, what_is_written_is_read_back_near_to_what_it_was) {
    for (const int channels : {1, 3}) {
        Image image(48, 40, channels, PixelFormat::u8, Encoding::linear);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < channels; ++c)
                    image.set(x, y, c, float(c == 0 ? x : c == 1 ? y : 40) / 47);
        const auto bytes = encode_jpeg(image, 95);
        ASSERT_TRUE(bytes) << bytes.error().message;
        const auto back = decode_image(*bytes, "written.jpg", ImageUse::data);
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(back->image.channels, channels);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < channels; ++c)
                    ASSERT_NEAR(back->image.at(x, y, c), image.at(x, y, c), 5.0f / 255);
    }
}

TEST(Jpeg, floats_and_alpha_are_not_written) {
    EXPECT_FALSE(encode_jpeg(Image(4, 4, 3), 90));
    EXPECT_FALSE(encode_jpeg(Image(4, 4, 4, PixelFormat::u8), 90));
    EXPECT_FALSE(encode_jpeg(Image(), 90));
}
