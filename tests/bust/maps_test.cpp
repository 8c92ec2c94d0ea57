#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bust/standard_bust.h"
#include "dermis/image/colour.h"
#include "dermis/optics/tissue/pigment_maps.h"
#include "subjects/bust/maps.h"

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

TEST(BustMaps, KernelsGrowInTheEarsWhichAreThin) {
    const Bust& b = standard_bust();
    EXPECT_GT(mean_near(b, b.kernel_size, {92, 15, -5}, 12).x, 0.3f);
    EXPECT_LT(mean_near(b, b.kernel_size, {0, 75, 95}, 10).x, 0.03f);
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

TEST(BustMaps, PigmentsAreThoseOfHealthySkinAndFollowTheFace) {
    const Bust& b = standard_bust();
    const auto blood = [&](Vec3 at, float radius_mm) {
        return pigment_fraction(double(mean_near(b, b.blood, at, radius_mm).x), kMostBlood);
    };
    const double forehead = blood({0, 75, 95}, 10), lips = blood({0, -43.5f, 117}, 3);
    EXPECT_GT(forehead, 0.003);
    EXPECT_LT(forehead, 0.015);
    EXPECT_GT(blood({0, -8, 129}, 7), 1.7 * forehead);
    EXPECT_GT(lips, 0.04);
    EXPECT_LT(lips, 0.1);
    const double melanin = pigment_fraction(double(mean_near(b, b.melanin, {0, 75, 95}, 10).x), kMostMelanin);
    EXPECT_NEAR(melanin, skin_model_of_tone(2).melanin, 0.004);
}

TEST(BustMaps, PigmentsAndResidueGiveTheAlbedoBack) {
    const Bust& b = standard_bust();
    const PigmentTable table{SkinModel{}};
    PigmentMaps maps{.melanin = b.melanin, .blood = b.blood, .residue = {}};
    add_residue(maps, b.albedo, table);
    const Image again = albedo_of({.maps = &maps}, table).value();
    int most = 0;
    for (size_t i = 0; i < b.albedo.bytes.size(); ++i)
        most = std::max(most, std::abs(int(b.albedo.bytes[i]) - int(again.bytes[i])));
    EXPECT_LE(most, 1);
}

/// Mean over the surface, by area, of what the map has at the vertices.
Vec3 mean_by_area(const bust::Atlas& atlas, const Image& map) {
    Vec3 sum;
    float total = 0;
    for (const auto& t : atlas.mesh.triangles) {
        const bust::Point a = atlas.mesh.points[size_t(t[0])];
        const float area =
            float(length(cross(atlas.mesh.points[size_t(t[1])] - a, atlas.mesh.points[size_t(t[2])] - a)));
        for (const int corner : t) {
            const bust::Point uv = atlas.uvs[size_t(corner)];
            const int x = int(uv.x * map.width), y = int(uv.y * map.height);
            sum += srgb_decode(Vec3{map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2)}) * area;
            total += area;
        }
    }
    return sum * (1 / total);
}

TEST(BustMaps, TheMeanOfTheUnshavedSkinIsTheToneWithinThreePercent) {
    const Mesh& mesh = standard_bust().mesh;
    bust::Atlas atlas;
    for (const Vec3 p : mesh.positions_mm) atlas.mesh.points.push_back({p.x, p.y, p.z});
    for (const Vec2 uv : mesh.uvs) atlas.uvs.push_back({uv.x, uv.y, 0});
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        atlas.mesh.triangles.push_back(
            {int(mesh.indices[i]), int(mesh.indices[i + 1]), int(mesh.indices[i + 2])});
    float last = 1;
    for (int tone = 1; tone <= 6; ++tone) {
        BustParams params{.tone = double(tone), .stubble = 0};
        const bust::SkinMaps bare = paint_maps(atlas, standard_field(), params, 512);
        const Vec3 mean = mean_by_area(atlas, bare.albedo), meant = skin_tone_albedo_linear(tone);
        EXPECT_NEAR(mean.x / meant.x, 1, 0.03f) << tone;
        EXPECT_NEAR(mean.y / meant.y, 1, 0.03f) << tone;
        EXPECT_NEAR(mean.z / meant.z, 1, 0.03f) << tone;
        EXPECT_LT(luminance(mean), last) << tone;
        last = luminance(mean);
    }
}

}  // namespace
}  // namespace dermis
