#include <gtest/gtest.h>

#include <cmath>

#include "bust/standard_bust.h"
#include "dermis/bust/skin.h"
#include "dermis/image/colour.h"

namespace dermis {
namespace {

/// Mean over the vertices near the skin's nearest point to `center` of what `map` has at their texture
/// coordinates; decoded if it is a colour.
Vec3 mean_near(const Bust& bust, const Image& map, Vec3 center, float radius_mm) {
    Vec3 sum;
    float count = 0;
    const bust::Point on_skin = standard_field().project({center.x, center.y, center.z}, 6);
    center = {float(on_skin.x), float(on_skin.y), float(on_skin.z)};
    for (size_t i = 0; i < bust.mesh.positions_mm.size(); ++i) {
        if (length(bust.mesh.positions_mm[i] - center) > radius_mm) continue;
        const Vec2 uv = bust.mesh.uvs[i];
        const int x = int(uv.x * float(map.width)), y = int(uv.y * float(map.height));
        const auto at = [&](int c) { return map.at(x, y, std::min(c, map.channels - 1)); };
        const Vec3 v = {at(0), at(1), at(2)};
        sum += map.encoding == Encoding::srgb ? srgb_decode(v) : v;
        ++count;
    }
    return sum * (1 / std::max(count, 1.0f));
}

float redness(Vec3 c) {
    return c.x / c.y;
}

TEST(BustMaps, LipsAreRedderThanTheForehead) {
    const Bust& b = standard_bust();
    const float lips = redness(mean_near(b, b.albedo, {0, -43.5f, 117}, 3)),
                forehead = redness(mean_near(b, b.albedo, {0, 75, 95}, 10));
    EXPECT_GT(lips, 1.3f * forehead);
}

TEST(BustMaps, NoseAndCheeksAreRedderThanTheForeheadButLessThanTheLips) {
    const Bust& b = standard_bust();
    const float forehead = redness(mean_near(b, b.albedo, {0, 75, 95}, 10));
    const float lips = redness(mean_near(b, b.albedo, {0, -43.5f, 117}, 3));
    for (const Vec3 p : {Vec3{0, -8, 129}, Vec3{45, -6, 84}}) {
        const float here = redness(mean_near(b, b.albedo, p, 7));
        EXPECT_GT(here, 1.05f * forehead);
        EXPECT_LT(here, lips);
    }
}

TEST(BustMaps, SkinScattersLessFarInTheEars) {
    const Bust& b = standard_bust();
    EXPECT_LT(mean_near(b, b.kernel_size, {92, 15, -5}, 12).x, 0.85f);
    EXPECT_GT(mean_near(b, b.kernel_size, {0, 75, 95}, 10).x, 0.97f);
}

TEST(BustMaps, NormalsAreUnitAndFaceOutward) {
    const Image& map = standard_bust().normal;
    double mean_z = 0;
    for (int y = 0; y < map.height; y += 3)
        for (int x = 0; x < map.width; x += 3) {
            const Vec3 n = Vec3{map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)} * 2.0f - Vec3{1, 1, 1};
            ASSERT_NEAR(length(n), 1, 0.02f);
            ASSERT_GT(n.z, 0.2f);
            mean_z += double(n.z);
        }
    EXPECT_GT(mean_z * 9 / double(map.pixel_count()), 0.95);
}

TEST(BustMaps, ToneGoesFromLightToDark) {
    float last = 2;
    for (const double tone : {1.0, 2.5, 4.0, 6.0}) {
        const Vec3 c = bust::tone_albedo_linear(tone);
        EXPECT_LT(luminance(c), last);
        EXPECT_GT(std::min({c.x, c.y, c.z}), 0);
        last = luminance(c);
    }
    // OpenPBR's first example, from ACEScg by hand: red = 1.7050510*.762 - .6217921*.652 - .0832589*.568.
    EXPECT_NEAR(bust::tone_albedo_linear(1).x, 0.84654f, 1e-4f);
}

}  // namespace
}  // namespace dermis
