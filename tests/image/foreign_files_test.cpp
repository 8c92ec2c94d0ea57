// Less common files of other programs: each is read as its format says, or refused by a line that names what
// is not supported.

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>

#include "dermis/base/vec.h"
#include "dermis/image/io.h"
#include "image/test_files.h"
#include "image/test_images.h"

using namespace dermis;

namespace {

Result<LoadedImage> decode_foreign(const FileBytes& file, ImageUse use = ImageUse::data) {
    return decode_image(file, "test", use);
}

std::vector<int> codes(const Result<LoadedImage>& loaded) {
    if (!loaded || loaded->image.format != PixelFormat::u8) return {};
    const auto values = loaded->image.values<uint8_t>();
    return {values.begin(), values.end()};
}

std::string message(const Result<LoadedImage>& loaded) {
    return loaded ? "read it" : loaded.error().message;
}

// The number of the file's channel that each channel of the image shows (make_exr's channels hold their
// number at the first texel).
std::vector<int> sources(const Image& image) {
    std::vector<int> numbers;
    for (int c = 0; c < image.channels; ++c) numbers.push_back(int(image.at(0, 0, c)));
    return numbers;
}

}  // namespace

TEST(ForeignExr, channels_are_taken_by_their_names) {
    struct Case {
        std::vector<std::string> channels;
        std::vector<int> data;  // numbers of the channels read; empty: refused
        std::vector<int> color;
    };
    const Case cases[] = {{{"R", "G", "B"}, {0, 1, 2}, {0, 1, 2}},
                          {{"A", "B", "G", "R"}, {3, 2, 1, 0}, {3, 2, 1, 0}},
                          {{"X", "Y", "Z"}, {0, 1, 2}, {}},
                          {{"A", "X", "Y", "Z"}, {1, 2, 3, 0}, {}},
                          {{"N.X", "N.Y", "N.Z"}, {0, 1, 2}, {0, 1, 2}},
                          {{"Y", "Z"}, {0}, {0}},
                          {{"Y", "A"}, {0, 1}, {0, 1}},
                          {{"b", "g", "r"}, {2, 1, 0}, {2, 1, 0}},
                          {{"Blue", "Green", "Red"}, {2, 1, 0}, {2, 1, 0}},
                          {{"BY", "RY", "Y"}, {}, {}},
                          {{"B", "G", "R", "X", "Y"}, {2, 1, 0}, {2, 1, 0}}};
    for (const Case& c : cases)
        for (const ImageUse use : {ImageUse::data, ImageUse::color}) {
            const Result<LoadedImage> loaded = decode_foreign(make_exr(2, 2, {.channels = c.channels}), use);
            const std::vector<int>& expected = use == ImageUse::data ? c.data : c.color;
            EXPECT_EQ(loaded ? sources(loaded->image) : std::vector<int>{}, expected)
                << c.channels[0] << ": " << message(loaded);
        }
}

TEST(ForeignExr, the_picture_is_the_display_window) {
    // Four by four texels from (2, 1); channel R holds x / 64 + y / 4096 of the data window.
    const ExrSettings inside = {
        .float_channels = true, .offset_x = 2, .offset_y = 1, .display = {0, 0, 7, 5}, .channels = {"R"}};
    const Result<LoadedImage> padded = decode_foreign(make_exr(4, 4, inside));
    ASSERT_TRUE(padded) << padded.error().message;
    ASSERT_EQ(padded->image.width, 8);
    ASSERT_EQ(padded->image.height, 6);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) {
            const bool held = x >= 2 && x < 6 && y >= 1 && y < 5;
            EXPECT_EQ(padded->image.at(x, y, 0), held ? float(x - 2) / 64 + float(y - 1) / 4096 : 0.0f);
        }
    // Overscan: the display window is the middle of the data.
    const ExrSettings around = {
        .float_channels = true, .offset_x = -1, .offset_y = -1, .display = {0, 0, 1, 1}, .channels = {"R"}};
    const Result<LoadedImage> cut = decode_foreign(make_exr(4, 4, around));
    ASSERT_TRUE(cut) << cut.error().message;
    ASSERT_EQ(cut->image.pixel_count(), 4u);
    EXPECT_EQ(cut->image.at(0, 0, 0), 1.0f / 64 + 1.0f / 4096);
    const ExrSettings beside = {.offset_x = 50, .display = {0, 0, 7, 5}, .channels = {"R"}};
    EXPECT_EQ(message(decode_foreign(make_exr(4, 4, beside))),
              "test: EXR whose data window lies outside of its display window");
}

TEST(ForeignJpeg, junk_between_header_markers_is_passed_over) {
    const Image image = test_pattern(16, 16, 3);
    const FileBytes plain = make_jpeg(image, 90, false);
    FileBytes junk = plain;
    // After the start of the image and its first segment.
    const size_t segment = 4 + size_t(plain[4]) * 256 + size_t(plain[5]);
    junk.insert(junk.begin() + std::ptrdiff_t(segment), 5, std::byte{0x11});
    const Result<LoadedImage> loaded = decode_foreign(junk);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->image.bytes, decode_foreign(plain)->image.bytes);
    FileBytes cut = plain;
    cut.resize(cut.size() / 2);
    EXPECT_FALSE(decode_foreign(cut)) << "a warning about missing texels stays an error";
}

TEST(ForeignPng, a_chunk_longer_than_the_file_is_refused_before_it_is_allocated) {
    FileBytes file = make_png({.width = 1, .height = 1, .color_type = PNG_COLOR_TYPE_GRAY}, {{9}});
    file.resize(8 + 25);  // the signature and the header
    for (const int byte :
         {0x7f, 0xff, 0xff, 0xff, int{'t'}, int{'E'}, int{'X'}, int{'t'}, int{'a'}, 0,  1,  2,
          3,    4,    5,    6,    7,        8,        9,        10,       11,       12, 13, 14})
        file.push_back(std::byte(byte));
    ASSERT_EQ(file.size(), 57u);
    EXPECT_EQ(message(decode_foreign(file)),
              "test: corrupt PNG: the file ends early: a chunk of 2147483647 bytes with 16 left");
}

TEST(ForeignPng, alpha_beside_linear_grey_stays_alpha) {
    PngSettings settings{.width = 1, .height = 1, .color_type = PNG_COLOR_TYPE_GRAY_ALPHA};
    EXPECT_EQ(codes(decode_foreign(make_png(settings, {{9, 77}}), ImageUse::color)),
              (std::vector<int>{9, 77}));
    EXPECT_EQ(codes(decode_foreign(make_png(settings, {{9, 77}}), ImageUse::data)),
              (std::vector<int>{9, 9, 9, 77}));
    settings.gamma = 1;
    EXPECT_EQ(codes(decode_foreign(make_png(settings, {{9, 77}}), ImageUse::color)),
              (std::vector<int>{9, 9, 9, 77}));
}

TEST(ForeignRadiance, repeats_of_the_oldest_coding_count_in_bytes_of_which_the_lower_may_be_zero) {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 257\n";
    FileBytes file;
    for (const char c : header) file.push_back(std::byte(c));
    // One texel and 256 = 0 + 1 * 256 repeats; a second row like the end of the first.
    for (const int byte : {128, 0, 0, 129, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1})
        file.push_back(std::byte(byte));
    const Result<LoadedImage> loaded = decode_foreign(file);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->image.at(256, 0, 0), 1.0f);
    EXPECT_EQ(loaded->image.at(0, 1, 0), 1.0f);
    EXPECT_EQ(loaded->image.at(256, 1, 0), 1.0f);
}

TEST(ForeignKtx2, channels_come_in_the_order_that_format_and_swizzle_say) {
    struct Case {
        uint32_t vulkan;
        const char* swizzle;
        std::vector<uint8_t> stored;
        std::vector<int> read;
    };
    const Case cases[] = {{23, "", {1, 2, 3}, {1, 2, 3}},
                          {29, "", {1, 2, 3}, {1, 2, 3}},
                          {30, "", {3, 2, 1}, {1, 2, 3}},
                          {44, "", {3, 2, 1, 4}, {1, 2, 3, 4}},
                          {50, "", {3, 2, 1, 4}, {1, 2, 3, 4}},
                          {9, "rrr1", {7}, {7, 7, 7}},
                          {16, "rrrg", {7, 9}, {7, 7, 7, 9}},
                          {37, "rgba", {1, 2, 3, 4}, {1, 2, 3, 4}},
                          {37, "rg01", {1, 2, 3, 4}, {1, 2, 0}},
                          {37, "abgr", {1, 2, 3, 4}, {4, 3, 2, 1}},
                          {9, "r001", {7}, {7}}};
    for (const Case& c : cases) {
        Ktx2Settings settings{.vulkan = c.vulkan};
        if (*c.swizzle) settings.pairs = {{"KTXswizzle", c.swizzle}};
        const Result<LoadedImage> loaded = decode_foreign(make_ktx2(settings, c.stored));
        EXPECT_EQ(codes(loaded), c.read) << c.vulkan << " " << c.swizzle << ": " << message(loaded);
        if (loaded) {
            EXPECT_TRUE(loaded->text.empty());
        }
    }
}

TEST(ForeignKtx2, rows_and_columns_come_in_the_order_that_the_orientation_says) {
    const auto read = [](const char* orientation) {
        return codes(decode_foreign(
            make_ktx2({.vulkan = 9, .width = 2, .height = 2, .pairs = {{"KTXorientation", orientation}}},
                      {1, 2, 3, 4})));
    };
    EXPECT_EQ(read("rd"), (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ(read("ru"), (std::vector<int>{3, 4, 1, 2}));
    EXPECT_EQ(read("ld"), (std::vector<int>{2, 1, 4, 3}));
    EXPECT_EQ(read("lu"), (std::vector<int>{4, 3, 2, 1}));
}

TEST(ForeignKtx2, what_is_not_read_is_named) {
    const auto refusal = [](uint32_t vulkan, std::pair<std::string, std::string> pair = {"a", "b"}) {
        return message(
            decode_foreign(make_ktx2({.vulkan = vulkan, .pairs = {std::move(pair)}}, {1, 2, 3, 4})));
    };
    EXPECT_NE(refusal(145).find("block-compressed KTX2 (VkFormat 145)"), std::string::npos);
    EXPECT_NE(refusal(5).find("KTX2 of VkFormat 5; dermis reads uncompressed 1 to 4 channels"),
              std::string::npos);
    EXPECT_NE(refusal(37, {"KTXswizzle", "rgbx"}).find("'rgbx' is not four of rgba01"), std::string::npos);
    EXPECT_NE(refusal(43, {"KTXswizzle", "agbr"}).find("alpha for an sRGB colour"), std::string::npos);
    EXPECT_NE(refusal(37, {"KTXorientation", "xx"}).find("orientation 'xx'"), std::string::npos);
}

TEST(ForeignDds, channels_come_in_the_order_that_format_or_masks_say) {
    struct Case {
        DdsSettings settings;
        std::vector<uint8_t> stored;
        std::vector<int> read;
    };
    constexpr uint32_t kRgb = 0x40, kAlpha = 1, kGrey = 0x20000;
    const Case cases[] = {
        {{.dxgi = 87}, {3, 2, 1, 4}, {1, 2, 3, 4}},
        {{.dxgi = 91}, {3, 2, 1, 4}, {1, 2, 3, 4}},
        {{.dxgi = 88}, {3, 2, 1, 0}, {1, 2, 3}},
        {{.flags = kRgb | kAlpha, .bits = 32, .masks = {0xff0000, 0xff00, 0xff, 0xff000000}},
         {3, 2, 1, 4},
         {1, 2, 3, 4}},
        {{.flags = kRgb, .bits = 32, .masks = {0xff0000, 0xff00, 0xff, 0}}, {3, 2, 1, 0}, {1, 2, 3}},
        {{.flags = kRgb, .bits = 24, .masks = {0xff0000, 0xff00, 0xff, 0}}, {3, 2, 1}, {1, 2, 3}},
        {{.flags = kRgb | kAlpha, .bits = 32, .masks = {0xff, 0xff00, 0xff0000, 0xff000000}},
         {1, 2, 3, 4},
         {1, 2, 3, 4}},
        {{.flags = kGrey, .bits = 8, .masks = {0xff, 0, 0, 0}}, {7}, {7}},
        {{.flags = kGrey | kAlpha, .bits = 16, .masks = {0xff, 0, 0, 0xff00}}, {7, 9}, {7, 7, 7, 9}},
    };
    for (const Case& c : cases)
        for (const ImageUse use : {ImageUse::data, ImageUse::color}) {
            const Result<LoadedImage> loaded = decode_foreign(make_dds(c.settings, c.stored), use);
            EXPECT_EQ(codes(loaded), c.read)
                << c.settings.dxgi << " " << c.settings.bits << ": " << message(loaded);
            if (loaded && c.settings.dxgi == 0) {
                EXPECT_EQ(loaded->image.encoding, use == ImageUse::color ? Encoding::srgb : Encoding::linear);
            }
        }
}

TEST(ForeignDds, what_is_not_read_is_named) {
    const auto refusal = [](const DdsSettings& settings) {
        return message(decode_foreign(make_dds(settings, std::vector<uint8_t>(16))));
    };
    EXPECT_NE(refusal({.dxgi = 98}).find("block-compressed DDS (DXGI format 98)"), std::string::npos);
    EXPECT_NE(refusal({.dxgi = 85}).find("DDS of DXGI format 85; dermis reads uncompressed"),
              std::string::npos);
    const DdsSettings packed = {.flags = 0x40, .bits = 16, .masks = {0xf800, 0x7e0, 0x1f, 0}};
    EXPECT_NE(refusal(packed).find("DDS of 16 bits a texel without a DX10 header"), std::string::npos);
}
