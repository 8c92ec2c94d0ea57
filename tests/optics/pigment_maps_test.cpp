#include "dermis/optics/tissue/pigment_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dermis/image/colour.h"

namespace dermis {
namespace {

const PigmentTable& usual_table() {
    static const PigmentTable table{SkinModel{}};
    return table;
}

TEST(PigmentTable, is_the_model_between_its_nodes) {
    for (const double melanin : {0.0, 0.013, 0.07, 0.21, 0.43, 0.5})
        for (const double blood : {0.0, 0.0037, 0.021, 0.09, 0.2}) {
            const Rgb made = usual_table().albedo({melanin, blood});
            const Rgb exact = skin_albedo({.melanin = melanin, .blood = blood});
            for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(made[c], exact[c], 0.002) << melanin << " " << blood;
        }
}

TEST(LayeredAlbedo, of_many_layers_is_that_of_each_pair) {
    const tissue::TissueLayer uppers[] = {{4, 0.2}, {4, 3}}, lowers[] = {{2, 0.01}, {4, 0.1}, {5, 2}};
    for (const double thickness_mm : {0.0, 0.06}) {
        const auto all = tissue::layered_albedos(uppers, thickness_mm, lowers, 0.8, 1.4);
        ASSERT_EQ(all.size(), 6u);
        for (size_t i = 0; i < 6; ++i)
            EXPECT_DOUBLE_EQ(all[i],
                             tissue::layered_albedo(uppers[i % 2], thickness_mm, lowers[i / 2], 0.8, 1.4));
    }
}

TEST(PigmentTable, finds_the_pigments_of_its_own_colours) {
    for (const double melanin : {0.005, 0.02, 0.08, 0.2, 0.4})
        for (const double blood : {0.002, 0.015, 0.05, 0.12}) {
            const Pigments found = usual_table().nearest(usual_table().albedo({melanin, blood}));
            EXPECT_NEAR(found.melanin, melanin, 0.002 + 0.02 * melanin) << melanin << " " << blood;
            EXPECT_NEAR(found.blood, blood, 0.001 + 0.03 * blood) << melanin << " " << blood;
        }
}

TEST(PigmentTable, makes_the_tones_of_the_bust_but_for_a_small_residue) {
    for (int tone = 1; tone <= 6; ++tone) {
        const Vec3 wanted = skin_tone_albedo_linear(tone);
        const Rgb made = usual_table().albedo(usual_table().nearest({wanted.x, wanted.y, wanted.z}));
        const double factors[] = {double(wanted.x) / made[0], double(wanted.y) / made[1],
                                  double(wanted.z) / made[2]};
        for (const double factor : factors)
            EXPECT_LT(std::abs(std::log(factor)), tone < 6 ? 0.25 : 0.4) << tone;
    }
}

// Skin, its shade, paint of any colour, black and white.
Image map_of_everything() {
    Image map(64, 48, 3, PixelFormat::u8, Encoding::srgb);
    std::mt19937 random(7);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double skin = (0.85 - 0.15 * c) * (x + 1) / 64;
                const double any = double(random() % 256) / 255;
                map.set(x, y, c, float(y < 24 ? skin : y < 46 ? any : y == 46 ? 0 : 1));
            }
    return map;
}

TEST(PigmentMaps, give_the_map_back_within_one_step_of_8_bits) {
    const Image map = map_of_everything();
    const PigmentMaps maps = pigment_maps_of(map, usual_table());
    const Result<Image> back = albedo_of({.maps = &maps}, usual_table());
    ASSERT_TRUE(back);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(back->at(x, y, c), map.at(x, y, c), 1.001f / 255) << x << " " << y << " " << c;
}

TEST(PigmentMaps, edits_do_what_they_are_called_and_stay_within_the_mask) {
    Image map(16, 4, 3, PixelFormat::u8, Encoding::srgb);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) map.set(x, y, 0, 0.8f), map.set(x, y, 1, 0.6f), map.set(x, y, 2, 0.5f);
    Image mask(16, 4, 1, PixelFormat::u8);
    for (int y = 0; y < 4; ++y)
        for (int x = 8; x < 16; ++x) mask.set(x, y, 0, 1);
    const PigmentMaps maps = pigment_maps_of(map, usual_table());
    const auto changed = [&](const SkinEdit& edit) {
        return albedo_of({.maps = &maps, .edit = edit, .mask = &mask}, usual_table()).value();
    };
    const auto lab = [](const Image& image, int x) {
        return lab_from_linear(srgb_decode(Vec3{image.at(x, 1, 0), image.at(x, 1, 1), image.at(x, 1, 2)}));
    };
    const Image blush = changed({.blush = 1}), tan = changed({.tan = 1}), pale = changed({.pallor = 0.8});
    for (const Image* image : {&blush, &tan, &pale})
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(image->at(2, 1, c), map.at(2, 1, c), 1.001f / 255);
    EXPECT_GT(lab(blush, 14).y, lab(map, 14).y + 5);
    EXPECT_LT(lab(pale, 14).y, lab(map, 14).y - 3);
    EXPECT_LT(lab(tan, 14).x, lab(map, 14).x - 1.5f);
}

TEST(PigmentMaps, take_a_missing_map_as_a_constant_and_refuse_different_sizes) {
    PigmentMaps maps{Image(4, 4, 1, PixelFormat::u8), {}, {}};
    const Result<Image> made = albedo_of({.maps = &maps, .missing = {0, 0.03}}, usual_table());
    ASSERT_TRUE(made);
    EXPECT_NEAR(made->at(1, 1, 1), srgb_encode(float(usual_table().albedo({0, 0.03})[1])), 0.003);
    maps.blood = Image(8, 4, 1, PixelFormat::u8);
    const Result<Image> wrong = albedo_of({.maps = &maps}, usual_table());
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message.find("4 x 4 and 8 x 4"), std::string::npos);
    const PigmentMaps none;
    EXPECT_FALSE(albedo_of({.maps = &none}, usual_table()));
}

}  // namespace
}  // namespace dermis
