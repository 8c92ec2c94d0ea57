#include "dermis/render/material_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "dermis/base/vec.h"
#include "dermis/image/io.h"
#include "test_paths.h"

using namespace dermis;

namespace {

Image map_of(const std::function<Vec3(Vec2)>& normal) {
    constexpr int kSide = 64;
    Image image(kSide, kSide, 3, PixelFormat::u8);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const Vec3 n = normal({(float(x) + 0.5f) / kSide, (float(y) + 0.5f) / kSide});
            for (int c = 0; c < 3; ++c) image.set(x, y, c, 0.5f + 0.5f * (&n.x)[c]);
        }
    return image;
}

Vec3 bumps(Vec2 uv) {
    return normalize(Vec3{0.5f * std::sin(20 * uv.x), 0.5f * std::sin(20 * uv.y), 1});
}
// Longitude and latitude, as the atlas of a ball has it.
Vec3 ball(Vec2 uv) {
    const float a = 6.2831853f * uv.x, b = 3.1415927f * uv.y;
    return {std::sin(a) * std::sin(b), std::cos(b), std::cos(a) * std::sin(b)};
}

bool doubts(const Image& image, NormalSpace space, const std::string& text) {
    const auto doubt = doubt_of_normal_map(image, space);
    return doubt && doubt->find(text) != std::string::npos;
}

}  // namespace

TEST(NormalMapCheck, maps_of_the_right_kind_pass) {
    EXPECT_FALSE(doubt_of_normal_map(map_of(bumps), NormalSpace::tangent));
    EXPECT_FALSE(doubt_of_normal_map(map_of(ball), NormalSpace::object));
    // Black between the charts, as painting programs leave it.
    EXPECT_FALSE(doubt_of_normal_map(map_of([](Vec2 uv) {
                                         return uv.x > 0.2f ? Vec3{-1, -1, -1} : bumps(uv);
                                     }),
                                     NormalSpace::tangent));
    EXPECT_FALSE(doubt_of_normal_map(map_of([](Vec2) { return Vec3{-1, -1, -1}; }), NormalSpace::tangent));
}

TEST(NormalMapCheck, maps_of_another_kind_are_named_with_the_mend) {
    EXPECT_TRUE(doubts(map_of(ball), NormalSpace::tangent, "normal_space = \"object\""));
    EXPECT_TRUE(doubts(map_of([](Vec2) {
                           return Vec3{0, 0, 1};
                       }),
                       NormalSpace::object, "normal_space = \"tangent\""));
    EXPECT_TRUE(doubts(map_of([](Vec2 uv) {
                           return Vec3{0.6f, 0.2f * uv.x, -0.1f};
                       }),
                       NormalSpace::tangent, "colour map"));
    EXPECT_TRUE(doubts(Image(8, 8, 1, PixelFormat::u8), NormalSpace::tangent, "three channels"));
}

TEST(NormalMapCheck, agrees_with_the_maps_of_a_scanned_head) {
    const char* assets = std::getenv("DERMIS_ASSETS");
    const auto folder =
        std::filesystem::path(assets ? assets : DERMIS_SOURCE_DIR "/../shared/assets") / "lee_perry_smith";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the head scan is not here";
    const auto check = [&](const char* name, NormalSpace space) {
        const auto image = read_image(folder / name, ImageUse::data);
        EXPECT_TRUE(image) << name;
        return image && !doubt_of_normal_map(image->image, space);
    };
    EXPECT_TRUE(check("normal_tangent_1024.jpg", NormalSpace::tangent));
    EXPECT_TRUE(check("normal_object_2048.jpg", NormalSpace::object));
    EXPECT_FALSE(check("normal_object_2048.jpg", NormalSpace::tangent));
    EXPECT_FALSE(check("normal_tangent_1024.jpg", NormalSpace::object));
    EXPECT_FALSE(check("color_2048.jpg", NormalSpace::tangent));
    EXPECT_FALSE(check("specular_2048.jpg", NormalSpace::tangent));
}
