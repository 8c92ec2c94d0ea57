#include "dermis/image/io.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "dermis/base/file.h"
#include "image/test_files.h"
#include "image/test_images.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace fs = std::filesystem;
using namespace dermis;

namespace {

bool is_one_line_about(const Error& error, std::string_view name) {
    return error.message.starts_with(name) && error.message.find('\n') == std::string::npos &&
           error.message.size() > name.size() + 3;
}

// A small file of each format and of each coding in which a truncation might not be noticed.
std::vector<std::pair<std::string, FileBytes>> one_of_each() {
    const Image image = test_pattern(19, 11, 3);
    const Image codes = convert(image, PixelFormat::u8, Encoding::srgb);
    const Image half = convert(test_pattern(9, 5, 4), PixelFormat::f16, Encoding::linear);
    const ImageText text = {{"credit", "somebody"}};
    std::vector<std::pair<std::string, FileBytes>> files = {
        {"png", *encode_image(".png", codes, text)},
        {"baseline.jpg", make_jpeg(image, 90, false)},
        {"progressive.jpg", make_jpeg(image, 90, true)},
        {"grey.jpg", make_jpeg(test_pattern(19, 11, 1), 90, false)},
        {"hdr", *encode_image(".hdr", image)},
        {"flat.hdr", *encode_image(".hdr", test_pattern(5, 5, 3))},
        {"dds", *encode_image(".dds", half)},
        {"ktx2", *encode_image(".ktx2", half, text)},
        {"exr", *encode_image(".exr", half, text)}};
    for (int compression = 0; compression < 10; ++compression)
        files.emplace_back("compression " + std::to_string(compression) + ".exr",
                           make_exr(13, 35, {.compression = compression, .channels = {"R", "G", "B"}}));
    files.emplace_back("tiled.exr", make_exr(20, 20, {.compression = 3, .tile_side = 8, .channels = {"R"}}));
    return files;
}

fs::path assets() {
    const char* set = std::getenv("DERMIS_ASSETS");
    return set ? fs::path(set) : fs::path(DERMIS_SOURCE_DIR) / "../shared/assets";
}

}  // namespace

TEST(ReadImage, every_prefix_of_every_format_is_a_one_line_error) {
    for (const auto& [name, file] : one_of_each()) {
        ASSERT_TRUE(decode_image(file, name, ImageUse::color))
            << decode_image(file, name, ImageUse::color).error().message;
        // Tiled files keep their smaller levels last, which a reader of the largest does not miss.
        const size_t end = name == "tiled.exr" ? file.size() / 2 : file.size();
        for (size_t length = 0; length < end; ++length) {
            const Result<LoadedImage> loaded =
                decode_image(std::span(file).first(length), name, ImageUse::color);
            ASSERT_FALSE(loaded) << name << ": " << length << " of " << file.size() << " bytes";
            ASSERT_TRUE(is_one_line_about(loaded.error(), name)) << loaded.error().message;
        }
    }
}

TEST(ReadImage, any_flipped_byte_is_an_error_or_a_whole_image) {
    for (const auto& [name, file] : one_of_each())
        for (size_t i = 0; i < file.size(); ++i) {
            FileBytes damaged = file;
            damaged[i] ^= std::byte(0x80 >> (i % 8));
            const Result<LoadedImage> loaded = decode_image(damaged, name, ImageUse::color);
            if (!loaded)
                ASSERT_TRUE(is_one_line_about(loaded.error(), name)) << loaded.error().message;
            else
                ASSERT_EQ(loaded->image.bytes.size(), loaded->image.pixel_count() *
                                                          size_t(loaded->image.channels) *
                                                          bytes_per_channel(loaded->image.format));
        }
}

TEST(ReadImage, the_content_decides_not_the_extension) {
    const TemporaryDirectory dir;
    const Image image = test_pattern(4, 4, 3);
    ASSERT_TRUE(write_file(dir.path / "really.jpg", *encode_image(".exr", image)));
    EXPECT_EQ(read_image(dir.path / "really.jpg", ImageUse::color)->image.bytes, image.bytes);
}

TEST(ReadImage, a_file_that_is_not_an_image_is_reported) {
    const TemporaryDirectory dir;
    ASSERT_TRUE(write_text_file(dir.path / "a.png", "not a picture"));
    ASSERT_TRUE(write_text_file(dir.path / "empty.png", ""));
    for (const fs::path& path :
         {dir.path, dir.path / "a.png", dir.path / "empty.png", dir.path / "missing.png"}) {
        const Result<LoadedImage> loaded = read_image(path, ImageUse::color);
        ASSERT_FALSE(loaded);
        EXPECT_TRUE(is_one_line_about(loaded.error(), path.string())) << loaded.error().message;
    }
}

TEST(ReadImage, an_unreadable_file_is_named) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
    const TemporaryDirectory dir;
    ASSERT_TRUE(write_image(dir.path / "a.png", Image(1, 1, 1)));
    ::chmod((dir.path / "a.png").c_str(), 0);
    const Result<LoadedImage> loaded = read_image(dir.path / "a.png", ImageUse::color);
    ASSERT_FALSE(loaded);
    EXPECT_TRUE(is_one_line_about(loaded.error(), (dir.path / "a.png").string()));
}

TEST(WriteImage, an_unknown_extension_and_an_empty_image_are_refused) {
    const TemporaryDirectory dir;
    const Result<void> written = write_image(dir.path / "a.tif", Image(1, 1, 1));
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find(".png, .exr, .hdr, .dds, .ktx2"), std::string::npos);
    EXPECT_FALSE(write_image(dir.path / "a.png", Image()));
    EXPECT_FALSE(write_image(dir.path / "noextension", Image(1, 1, 1)));
    EXPECT_TRUE(fs::is_empty(dir.path));
}

TEST(WriteImage, every_extension_reads_back_as_the_same_picture) {
    const TemporaryDirectory dir;
    const Image image = test_pattern(21, 13, 3);
    for (const char* extension : {".png", ".exr", ".hdr", ".dds", ".ktx2", ".PNG"}) {
        const fs::path path = dir.path / (std::string("picture") + extension);
        ASSERT_TRUE(write_image(path, image));
        const Result<LoadedImage> loaded = read_image(path, ImageUse::color);
        ASSERT_TRUE(loaded) << loaded.error().message;
        Image rgb(21, 13, 3);
        const Image linear = to_linear_float(loaded->image);
        for (int y = 0; y < 13; ++y)
            for (int x = 0; x < 21; ++x)
                for (int c = 0; c < 3; ++c) rgb.set(x, y, c, linear.at(x, y, c));
        EXPECT_LT(largest_difference(rgb, image), 0.005f) << extension;
    }
}

TEST(ReadImage, the_test_assets_have_their_sizes_and_ranges) {
    if (!fs::exists(assets() / "hdri")) GTEST_SKIP() << "no assets beside the repository (set DERMIS_ASSETS)";
    const Result<LoadedImage> color =
        read_image(assets() / "lee_perry_smith/color_2048.jpg", ImageUse::color);
    ASSERT_TRUE(color) << color.error().message;
    EXPECT_EQ(color->image.width, 2048);
    EXPECT_EQ(color->image.format, PixelFormat::u8);
    for (const char* name : {"studio.hdr", "sunset.hdr", "apartment.hdr", "courtyard.exr"}) {
        const Result<LoadedImage> environment = read_image(assets() / "hdri" / name, ImageUse::color);
        ASSERT_TRUE(environment) << environment.error().message;
        EXPECT_EQ(environment->image.width, 1024);
        EXPECT_EQ(environment->image.height, 512);
        const Image linear = to_linear_float(environment->image);
        double sum = 0;
        for (const float value : linear.floats()) sum += value;
        EXPECT_GT(sum / double(linear.floats().size()), 0.01) << name;
        EXPECT_LT(sum / double(linear.floats().size()), 100.0) << name;
    }
}
