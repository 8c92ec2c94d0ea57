#include <gtest/gtest.h>
#include <png.h>

#include "dermis/image/io.h"
#include "image/test_files.h"
#include "image/test_images.h"

using namespace dermis;

namespace {

Result<LoadedImage> decode_test_png(const FileBytes& file, ImageUse use = ImageUse::color) {
    return decode_image(file, "test.png", use);
}

}  // namespace

TEST(Png, grey_of_every_depth_spans_0_to_1) {
    for (const int depth : {1, 2, 4, 8, 16}) {
        const PngSettings settings{
            .width = 2, .height = 1, .depth = depth, .color_type = PNG_COLOR_TYPE_GRAY};
        // A black texel and a white one, packed from the high bits down.
        const std::vector<uint8_t> row =
            depth == 16  ? std::vector<uint8_t>{0, 0, 255, 255}
            : depth == 8 ? std::vector<uint8_t>{0, 255}
                         : std::vector<uint8_t>{uint8_t(((1 << depth) - 1) << (8 - 2 * depth))};
        const Result<LoadedImage> loaded = decode_test_png(make_png(settings, {row}), ImageUse::data);
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(loaded->image.channels, 1);
        EXPECT_EQ(loaded->image.format, depth == 16 ? PixelFormat::u16 : PixelFormat::u8);
        EXPECT_EQ(loaded->image.at(0, 0, 0), 0.0f) << depth;
        EXPECT_EQ(loaded->image.at(1, 0, 0), 1.0f) << depth;
    }
}

TEST(Png, sixteen_bits_keep_their_low_byte) {
    const PngSettings settings{.width = 1, .height = 1, .depth = 16, .color_type = PNG_COLOR_TYPE_RGB};
    const Result<LoadedImage> loaded = decode_test_png(make_png(settings, {{0x12, 0x34, 0, 1, 0xff, 0xfe}}));
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->image.values<uint16_t>()[0], 0x1234);
    EXPECT_EQ(loaded->image.values<uint16_t>()[1], 1);
    EXPECT_EQ(loaded->image.values<uint16_t>()[2], 0xfffe);
}

TEST(Png, palettes_become_rgb_and_with_transparency_rgba) {
    for (const bool alpha : {false, true}) {
        const PngSettings settings{.width = 4,
                                   .height = 1,
                                   .depth = 4,
                                   .color_type = PNG_COLOR_TYPE_PALETTE,
                                   .palette_alpha = alpha};
        const Result<LoadedImage> loaded = decode_test_png(make_png(settings, {{0x01, 0x7f}}));
        ASSERT_TRUE(loaded) << loaded.error().message;
        ASSERT_EQ(loaded->image.channels, alpha ? 4 : 3);
        const std::span<const uint8_t> texel =
            loaded->image.values<uint8_t>().subspan(size_t(loaded->image.channels) * 2);
        EXPECT_EQ(texel[0], 7);
        EXPECT_EQ(texel[1], 14);
        EXPECT_EQ(texel[2], 21);
        if (alpha) {
            EXPECT_EQ(texel[3], 248);
        }
    }
}

TEST(Png, interlaced_files_read_like_plain_ones) {
    std::vector<std::vector<uint8_t>> rows;
    for (int y = 0; y < 11; ++y) {
        rows.emplace_back();
        for (int x = 0; x < 13; ++x) rows.back().push_back(uint8_t(x * 16 + y));
    }
    PngSettings settings{.width = 13, .height = 11, .color_type = PNG_COLOR_TYPE_GRAY};
    const Result<LoadedImage> plain = decode_test_png(make_png(settings, rows));
    settings.interlaced = true;
    const Result<LoadedImage> interlaced = decode_test_png(make_png(settings, rows));
    ASSERT_TRUE(plain);
    ASSERT_TRUE(interlaced);
    EXPECT_EQ(plain->image.bytes, interlaced->image.bytes);
    EXPECT_EQ(plain->image.values<uint8_t>()[13 * 3 + 2], 35);
}

TEST(Png, colour_is_srgb_unless_the_file_says_its_gamma_is_1) {
    PngSettings settings{.width = 1, .height = 1, .color_type = PNG_COLOR_TYPE_GRAY};
    EXPECT_EQ(decode_test_png(make_png(settings, {{9}}))->image.encoding, Encoding::srgb);
    EXPECT_EQ(decode_test_png(make_png(settings, {{9}}), ImageUse::data)->image.encoding, Encoding::linear);
    settings.gamma = 1.0;
    EXPECT_EQ(decode_test_png(make_png(settings, {{9}}))->image.encoding, Encoding::linear);
    settings.gamma = 0.45455;
    EXPECT_EQ(decode_test_png(make_png(settings, {{9}}))->image.encoding, Encoding::srgb);
}

TEST(Png, what_is_written_reads_back_byte_by_byte_with_its_text) {
    const ImageText text = {{"Comment", "skin \xc3\xa9"},
                            {"dermis.sidecar", "{\"axes\": [\"n_dot_l\", \"curvature\"]}"}};
    for (const PixelFormat format : {PixelFormat::u8, PixelFormat::u16})
        for (int channels = 1; channels <= 4; ++channels) {
            const Image image = convert(test_pattern(7, 5, channels), format, Encoding::srgb);
            const Result<FileBytes> file = encode_image(".png", image, text);
            ASSERT_TRUE(file) << file.error().message;
            const Result<LoadedImage> loaded = decode_test_png(*file);
            ASSERT_TRUE(loaded) << loaded.error().message;
            EXPECT_EQ(loaded->image.bytes, image.bytes);
            EXPECT_EQ(loaded->image.format, format);
            EXPECT_EQ(loaded->text, text);
        }
}

TEST(Png, float_images_are_written_as_8_bit_srgb) {
    const Image image = test_pattern(4, 4, 3);
    const Result<LoadedImage> loaded = decode_test_png(*encode_image(".png", image));
    EXPECT_EQ(loaded->image.format, PixelFormat::u8);
    EXPECT_LT(largest_difference(loaded->image, image), 0.005f);
}

TEST(Png, a_text_key_that_no_format_takes_is_refused) {
    for (const char* key : {"", " x", "x  y", "\xc3\xa9", "a\nb"})
        EXPECT_FALSE(encode_image(".png", Image(1, 1, 1), {{key, "v"}})) << key;
    EXPECT_FALSE(encode_image(".png", Image(1, 1, 1), {{std::string(80, 'k'), "v"}}));
    EXPECT_TRUE(encode_image(".png", Image(1, 1, 1), {{std::string(79, 'k'), "v"}}));
}

TEST(Png, a_damaged_checksum_and_a_huge_size_are_errors) {
    FileBytes file = *encode_image(".png", convert(test_pattern(8, 8, 3), PixelFormat::u8, Encoding::srgb));
    FileBytes damaged = file;
    damaged[file.size() - 30] ^= std::byte{1};
    EXPECT_NE(decode_test_png(damaged).error().message.find("test.png: corrupt PNG"), std::string::npos);
    damaged = file;
    damaged[18] = std::byte{0x7f};  // the width's third byte
    EXPECT_FALSE(decode_test_png(damaged));
}
