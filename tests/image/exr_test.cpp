#include <ImfCompression.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "dermis/base/file.h"
#include "dermis/image/codec/codec.h"
#include "image/test_files.h"
#include "image/test_images.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

Result<LoadedImage> decode_test_exr(const FileBytes& file) {
    return decode_image(file, "test.exr", ImageUse::color);
}

// How make_exr's channels lie: number `index` in the file is channel `channel` of the image.
void expect_pattern(const Image& image, int channel, int index, float tolerance) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            ASSERT_NEAR(image.at(x, y, channel), float(index) + float(x) / 64 + float(y) / 4096, tolerance);
}

}  // namespace

TEST(Exr, every_compression_reads_scanlines_and_tiles) {
    for (int compression = Imf::NO_COMPRESSION; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
        for (const int tile_side : {0, 16}) {
            const Result<LoadedImage> loaded = decode_test_exr(make_exr(
                40, 36, {.compression = compression, .tile_side = tile_side, .channels = {"R", "G", "B"}}));
            ASSERT_TRUE(loaded) << compression << ": " << loaded.error().message;
            EXPECT_EQ(loaded->image.format, PixelFormat::f16);
            const bool lossy = compression >= Imf::B44_COMPRESSION;
            for (int c = 0; c < 3; ++c) expect_pattern(loaded->image, c, c, lossy ? 0.04f : 1.5e-3f);
        }
}

TEST(Exr, float_channels_stay_float_and_the_data_window_may_lie_anywhere) {
    const Result<LoadedImage> loaded = decode_test_exr(make_exr(20, 10,
                                                                {.compression = Imf::ZIP_COMPRESSION,
                                                                 .float_channels = true,
                                                                 .offset_x = -7,
                                                                 .offset_y = 100,
                                                                 .channels = {"A", "B", "G", "R", "Z"}}));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->image.format, PixelFormat::f32);
    ASSERT_EQ(loaded->image.channels, 4);
    for (int c = 0; c < 4; ++c) expect_pattern(loaded->image, c, 3 - c, 0);
}

TEST(Exr, luminance_single_channels_and_single_layers_are_read_as_an_image) {
    for (const std::vector<std::string>& channels :
         {std::vector<std::string>{"Y"}, {"curvature"}, {"thickness.Z"}}) {
        const Result<LoadedImage> loaded = decode_test_exr(make_exr(8, 8, {.channels = channels}));
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(loaded->image.channels, 1);
    }
    EXPECT_EQ(
        decode_test_exr(make_exr(8, 8, {.channels = {"beauty.R", "beauty.G", "beauty.B"}}))->image.channels,
        3);
    EXPECT_EQ(decode_test_exr(make_exr(8, 8, {.channels = {"R", "G", "B", "Y"}}))->image.channels, 3);
    const Result<LoadedImage> ambiguous = decode_test_exr(make_exr(8, 8, {.channels = {"a.R", "b.R"}}));
    ASSERT_FALSE(ambiguous);
    EXPECT_NE(ambiguous.error().message.find("a.R, b.R"), std::string::npos) << ambiguous.error().message;
}

TEST(Exr, half_and_float_images_read_back_exactly_with_their_text) {
    const ImageText text = {{"dermis.sidecar", "{\"unit\": \"mm\"}"}, {"credit", "Lee Perry-Smith"}};
    for (const PixelFormat format : {PixelFormat::f16, PixelFormat::f32})
        for (int channels = 1; channels <= 4; ++channels) {
            const Image image = convert(test_pattern(33, 17, channels), format, Encoding::linear);
            const Result<FileBytes> file = encode_image(".exr", image, text);
            ASSERT_TRUE(file) << file.error().message;
            const Result<LoadedImage> loaded = decode_test_exr(*file);
            ASSERT_TRUE(loaded) << loaded.error().message;
            EXPECT_EQ(loaded->image.bytes, image.bytes);
            EXPECT_EQ(loaded->image.channels, channels);
            EXPECT_EQ(loaded->text, text);
        }
}

TEST(Exr, text_must_not_overwrite_what_a_header_needs) {
    for (const char* key : {"channels", "compression", "type", "dataWindow"})
        EXPECT_FALSE(encode_image(".exr", Image(1, 1, 1), {{key, "x"}})) << key;
}

TEST(Exr, eight_bit_colour_becomes_linear_half) {
    const Image image = convert(test_pattern(9, 9, 3), PixelFormat::u8, Encoding::srgb);
    const Result<LoadedImage> loaded = decode_test_exr(*encode_image(".exr", image));
    EXPECT_EQ(loaded->image.format, PixelFormat::f16);
    EXPECT_LT(largest_difference(loaded->image, image), 5e-4f);
}

TEST(Exr, layers_of_several_kinds_read_back_and_the_plain_one_is_the_image) {
    const TemporaryDirectory dir;
    const std::vector<ImageLayer> layers = {
        {"", convert(test_pattern(12, 6, 4), PixelFormat::f16, Encoding::linear)},
        {"reference", test_pattern(12, 6, 3)},
        {"sss.irradiance", test_pattern(12, 6, 2)},
        {"thickness", convert(test_pattern(12, 6, 1), PixelFormat::f16, Encoding::linear)}};
    const Result<void> written = write_layered_exr(dir.path / "all.exr", layers, {{"credit", "x"}});
    ASSERT_TRUE(written) << written.error().message;
    const Result<LayeredImage> read = read_layered_exr(dir.path / "all.exr");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->layers.size(), layers.size());
    for (size_t i = 0; i < layers.size(); ++i) {
        EXPECT_EQ(read->layers[i].name, layers[i].name);
        EXPECT_EQ(read->layers[i].image.format, layers[i].image.format);
        EXPECT_EQ(read->layers[i].image.bytes, layers[i].image.bytes);
    }
    EXPECT_EQ(read->text.at("credit"), "x");
    EXPECT_EQ(read_image(dir.path / "all.exr", ImageUse::color)->image.bytes, layers[0].image.bytes);
}

TEST(Exr, layers_that_do_not_fit_together_are_refused_and_nothing_is_written) {
    const TemporaryDirectory dir;
    const std::vector<ImageLayer> sizes = {{"a", Image(2, 2, 1)}, {"b", Image(3, 2, 1)}};
    const std::vector<ImageLayer> twice = {{"a", Image(2, 2, 1)}, {"a", Image(2, 2, 1)}};
    EXPECT_FALSE(write_layered_exr(dir.path / "x.exr", sizes));
    EXPECT_FALSE(write_layered_exr(dir.path / "x.exr", twice));
    EXPECT_FALSE(write_layered_exr(dir.path / "x.exr", {}));
    EXPECT_TRUE(std::filesystem::is_empty(dir.path));
}

namespace {

// make_exr's file of 8x8 texels with the last column and row of its data window set to `x` and `y`.
FileBytes with_window_end(FileBytes file, int32_t x, int32_t y) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    const size_t window = text.find("dataWindow") + sizeof("dataWindow") + sizeof("box2i") + 4;
    std::memcpy(file.data() + window + 8, &x, 4);
    std::memcpy(file.data() + window + 12, &y, 4);
    return file;
}

}  // namespace

TEST(Exr, a_header_with_an_impossible_size_is_refused_before_openexr_allocates) {
    const auto message = [](int compression, int32_t x, int32_t y) {
        const FileBytes file = make_exr(8, 8, {.compression = compression, .channels = {"R"}});
        const Result<LoadedImage> loaded = decode_test_exr(with_window_end(file, x, y));
        return loaded ? std::string("read it") : loaded.error().message;
    };
    EXPECT_EQ(message(Imf::PIZ_COMPRESSION, 7, 7), "read it");
    constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
    EXPECT_EQ(message(Imf::PIZ_COMPRESSION, kMost, kMost),
              "test.exr: holds 2147483648 x 2147483648 texels; the largest side is 16384");
    EXPECT_EQ(message(Imf::PIZ_COMPRESSION, -1, 7), "test.exr: corrupt EXR: a data window without texels");
    // 512 chunks need a table of 4096 bytes, whatever is in them.
    EXPECT_EQ(message(Imf::PIZ_COMPRESSION, 7, 16383),
              "test.exr: corrupt EXR: the file is too short for its size");
    EXPECT_NE(message(Imf::ZIP_COMPRESSION, 16383, 127).find("too short a file"), std::string::npos);
}

// OpenEXR would read the value by its type and go on from there: with a size of 1.7 GB from what is none.
TEST(Exr, an_attribute_of_another_size_than_its_type_has_is_refused) {
    for (const auto& [file, message] :
         {std::pair{"wrong_attribute_size", "has 0 bytes, not those of its type"},
          {"channels_past_the_end", "the attribute 'channels' has"},
          {"channel_list_of_another_name",
           "the attribute 'pixes' has 59 bytes, not those of its type chlist"}}) {
        const auto bytes = read_file(std::string(DERMIS_SOURCE_DIR "/tests/fuzz/corpus/exr/") + file);
        ASSERT_TRUE(bytes) << bytes.error().message;
        const auto image = codec::decode_exr(*bytes, ImageUse::data);
        ASSERT_FALSE(image) << file;
        EXPECT_NE(image.error().message.find(message), std::string::npos) << image.error().message;
    }
}

TEST(Exr, a_channel_name_with_line_breaks_stays_on_the_line_of_the_error) {
    const Result<LoadedImage> loaded = decode_test_exr(make_exr(4, 4, {.channels = {"a\n.R", "b.R"}}));
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message.find("a?.R, b.R"), std::string::npos) << loaded.error().message;
}
