// Text in pictures. The font is a package of tools/apt.txt, so its absence is a failure here.

#include "dermis/image/label.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "dermis/base/file.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

Font load() {
    Result<Font> font = Font::load();
    EXPECT_TRUE(font) << font.error().message;
    return std::move(*font);
}

// How many texels are no longer black, and the columns they span.
struct Ink {
    int count = 0, first = 1 << 20, last = -1;
};
Ink ink_of(const Image& image) {
    Ink ink;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y, 0) > 0.2f) {
                ++ink.count;
                ink.first = std::min(ink.first, x);
                ink.last = std::max(ink.last, x);
            }
    return ink;
}

Ink drawn(const Font& font, const std::string& text, int x = 4, int y = 2) {
    Image image(120, 24, 3, PixelFormat::u8, Encoding::srgb);
    font.draw(image, x, y, text, {.size_px = 14, .color = {1, 1, 1}});
    return ink_of(image);
}

}  // namespace

TEST(Label, is_as_wide_as_it_says_and_starts_where_it_is_put) {
    const Font font = load();
    const int width = font.width_px("mm 1/8", 14);
    EXPECT_GT(width, 30);
    EXPECT_LT(width, 60);
    const Ink ink = drawn(font, "mm 1/8");
    EXPECT_GT(ink.count, 40);
    EXPECT_GE(ink.first, 4);
    EXPECT_LE(ink.first, 7);
    EXPECT_LE(ink.last, 4 + width);
    EXPECT_GE(ink.last, 4 + width - 4);
    EXPECT_NEAR(font.width_px("mm 1/8", 28), 2 * width, 4);
}

TEST(Label, takes_its_colour_and_leaves_alpha_alone) {
    const Font font = load();
    Image image(40, 24, 4);
    font.draw(image, 2, 2, "M", {.size_px = 18, .color = {0.5f, 1, 0.25f}});
    float green = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 40; ++x) {
            green = std::max(green, image.at(x, y, 1));
            EXPECT_FLOAT_EQ(image.at(x, y, 0), 0.5f * image.at(x, y, 1));
            EXPECT_EQ(image.at(x, y, 3), 0);
        }
    EXPECT_FLOAT_EQ(green, 1);
}

TEST(Label, is_clipped_at_the_edges) {
    const Font font = load();
    for (const auto& [x, y] : {std::pair{-30, 2}, {110, 2}, {4, -10}, {4, 20}, {500, 500}, {-5000, 0}})
        EXPECT_LT(drawn(font, "clipped label", x, y).count, drawn(font, "clipped label").count);
}

TEST(Label, reads_utf_8_and_replaces_invalid_bytes) {
    const Font font = load();
    EXPECT_LT(font.width_px("·", 14), font.width_px("W", 14)) << "one character, not two bytes";
    EXPECT_NE(font.width_px("Δ", 14), font.width_px("\xFF", 14));
    for (const char* broken : {"\xFF", "\xC3", "\xE2\x82", "\xF0\x9F", "a\x80z", "\xC3("})
        EXPECT_GT(drawn(font, broken).count, 0) << "shows as a box";
}

TEST(Label, is_wrapped_at_spaces) {
    const Font font = load();
    const std::string text = "one two three four";
    const std::vector<std::string> lines = font.wrap(text, 14, font.width_px("one two", 14));
    EXPECT_EQ(lines, (std::vector<std::string>{"one two", "three", "four"}));
    EXPECT_EQ(font.wrap("unbreakable", 14, 5), std::vector<std::string>{"unbreakable"});
}

TEST(Label, of_a_file_that_is_not_a_font_is_an_error) {
    const TemporaryDirectory directory;
    const auto path = directory.path / "no.ttf";
    ASSERT_TRUE(write_text_file(path, "not a font"));
    EXPECT_EQ(Font::load(path).error().message,
              path.string() + ": not a scalable font that FreeType can read");
    EXPECT_FALSE(Font::load(directory.path / "absent.ttf"));
}
