#include "dermis/image/dilate.h"

#include <gtest/gtest.h>

#include "image/test_images.h"

using namespace dermis;

namespace {

// One texel in forty, by a hash without rows or columns of its own.
Image scattered_mask(int width, int height) {
    Image mask(width, height, 1, PixelFormat::u8);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            uint32_t h = uint32_t(y * width + x) * 2654435761u;
            h = (h ^ h >> 15) * 2246822519u;
            mask.set(x, y, 0, (h ^ h >> 13) % 40 == 0 ? 1.0f : 0.0f);
        }
    return mask;
}

}  // namespace

TEST(Dilate, every_texel_within_reach_takes_the_nearest_one_inside_and_no_other_changes) {
    const Image mask = scattered_mask(37, 29), before = test_pattern(37, 29, 3);
    for (const int reach : {0, 1, 2, 5, 20}) {
        Image after = before;
        dilate(after, mask, reach);
        for (int y = 0; y < 29; ++y)
            for (int x = 0; x < 37; ++x) {
                // By brute force, upper and left ones first.
                int best = reach * reach + 1, from_x = x, from_y = y;
                for (int sy = 0; sy < 29; ++sy)
                    for (int sx = 0; sx < 37; ++sx) {
                        const int square = (sx - x) * (sx - x) + (sy - y) * (sy - y);
                        if (mask.at(sx, sy, 0) > 0 && square < best) best = square, from_x = sx, from_y = sy;
                    }
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(after.at(x, y, c), before.at(from_x, from_y, c))
                        << x << ' ' << y << " reach " << reach;
            }
    }
}

TEST(Dilate, an_empty_mask_changes_nothing_and_a_full_one_neither) {
    const Image before = convert(test_pattern(8, 8, 4), PixelFormat::u8, Encoding::srgb);
    Image after = before, full(8, 8, 1);
    dilate(after, Image(8, 8, 1), 100);
    EXPECT_EQ(after.bytes, before.bytes);
    for (float& value : full.floats()) value = 1;
    dilate(after, full, 100);
    EXPECT_EQ(after.bytes, before.bytes);
}

TEST(Dilate, one_texel_fills_a_disc) {
    Image image(11, 11, 1, PixelFormat::f16), mask(11, 11, 1);
    image.set(5, 5, 0, 2.0f);
    mask.set(5, 5, 0, 1.0f);
    dilate(image, mask, 3);
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 11; ++x)
            EXPECT_EQ(image.at(x, y, 0), (x - 5) * (x - 5) + (y - 5) * (y - 5) <= 9 ? 2.0f : 0.0f);
}

TEST(Dilate, between_two_texels_of_a_row_or_column_each_takes_its_half) {
    for (const bool column : {false, true}) {
        const int width = column ? 1 : 10, height = column ? 10 : 1;
        Image image(width, height, 1), mask(width, height, 1);
        image.floats()[0] = 1, image.floats()[9] = 2;
        mask.floats()[0] = mask.floats()[9] = 1;
        dilate(image, mask, 9);
        for (size_t i = 0; i < 10; ++i) EXPECT_EQ(image.floats()[i], i < 5 ? 1.0f : 2.0f) << i;
    }
}
