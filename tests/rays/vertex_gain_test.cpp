#include "dermis/rays/vertex_gain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dermis/mesh/primitives.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/bake_map.h"
#include "dermis/rays/curvature_gain.h"
#include "dermis/rays/map_file.h"
#include "tests/support/temporary_directory.h"

namespace dermis {
namespace {

const ScatteringMedium& skin_medium() {
    static const ScatteringMedium kMedium = walk_medium_of(*find_profile("openpbr_skin_3"));
    return kMedium;
}

SceneObject ball(float radius_mm) {
    return {.name = "ball", .mesh = make_sphere(radius_mm, 64), .classes = {MaterialClass::skin}};
}

VertexGains gains_of(const SceneObject& object, const VertexGainSettings& settings = {}) {
    Result<VertexGains> walked = walk_vertex_gains(std::span(&object, 1), skin_medium(), settings);
    EXPECT_TRUE(walked) << walked.error().message;
    return *walked;
}

struct Spread {
    Vec3 mean, deviation;
};
Spread spread_of(const std::vector<Vec3>& values) {
    Spread spread;
    const float share = 1 / float(values.size());
    for (const Vec3& value : values) spread.mean += value * share;
    for (const Vec3& value : values) {
        const Vec3 off = value - spread.mean;
        spread.deviation += off * off * share;
    }
    for (float Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z})
        spread.deviation.*c = std::sqrt(spread.deviation.*c);
    return spread;
}

TEST(VertexGain, OfABallIsThatOfWalksInABall) {
    const Spread spread = spread_of(gains_of(ball(4)).gains[0]);
    const WalkedGains expected = walk_gain(skin_medium(), std::array{0.25}, 1 << 17, 3);
    EXPECT_NEAR(spread.mean.x, expected.samples[0].gain[0], 0.015);
    EXPECT_NEAR(spread.mean.y, expected.samples[0].gain[1], 0.015);
    EXPECT_NEAR(spread.mean.z, expected.samples[0].gain[2], 0.015);
}

TEST(VertexGain, StatesItsNoise) {
    // All places of a ball have one gain, so what differs is noise.
    const VertexGains walked = gains_of(ball(16), {.walks_per_mm2 = 2, .least_walks = 1});
    const Spread spread = spread_of(walked.gains[0]);
    EXPECT_GT(walked.noise.x, 0.005f);
    EXPECT_NEAR(spread.deviation.x / walked.noise.x, 1, 0.6);
    EXPECT_NEAR(spread.deviation.y / walked.noise.y, 1, 0.6);
    EXPECT_NEAR(spread.deviation.z / walked.noise.z, 1, 0.6);
    const VertexGains finer = gains_of(ball(16), {.walks_per_mm2 = 32, .least_walks = 1});
    EXPECT_LT(finer.noise.x, 0.4f * walked.noise.x);
}

TEST(VertexGain, OfWhatIsNotSkinIsOne) {
    SceneObject objects[] = {ball(4), ball(4)};
    objects[1].classes = {MaterialClass::other};
    for (Vec3& p : objects[1].mesh.positions_mm) p.x += 20;
    const Result<VertexGains> walked = walk_vertex_gains(objects, skin_medium(), {.least_walks = 1 << 12});
    ASSERT_TRUE(walked) << walked.error().message;
    for (const Vec3& value : walked->gains[1]) EXPECT_EQ(value, (Vec3{1, 1, 1}));
    const Result<VertexGains> none = walk_vertex_gains(std::span(objects).subspan(1), skin_medium());
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message, "there is no skin that returns light to the outside");
}

// As an eyeball hides the back of its lid: a cup around the lower half of a ball.
TEST(VertexGain, CountsNoLightFromHiddenSkin) {
    SceneObject objects[] = {ball(4), ball(4)};
    Mesh& cup = objects[1].mesh;
    objects[1].classes = {MaterialClass::other};
    for (Vec3& p : cup.positions_mm) p = p * 1.2f;
    std::vector<uint32_t> lower;
    for (size_t i = 0; i < cup.indices.size(); i += 3)
        if (cup.positions_mm[cup.indices[i]].y < 0)
            lower.insert(lower.end(), cup.indices.begin() + std::ptrdiff_t(i),
                         cup.indices.begin() + std::ptrdiff_t(i) + 3);
    cup.indices = lower;
    cup.submeshes[0].index_count = uint32_t(lower.size());
    const std::vector<Vec3> open = gains_of(objects[0]).gains[0];
    const Result<VertexGains> walked = walk_vertex_gains(objects, skin_medium());
    ASSERT_TRUE(walked) << walked.error().message;
    Vec3 lost;
    float count = 0;
    for (size_t v = 0; v < open.size(); ++v)
        if (objects[0].mesh.positions_mm[v].y > 2) lost += open[v] - walked->gains[0][v], ++count;
    EXPECT_GT(lost.x / count, 0.05f);
    EXPECT_GT(lost.x, lost.z);
}

TEST(VertexGain, RefusesSettingsOutOfRange) {
    const SceneObject object = ball(4);
    EXPECT_FALSE(walk_vertex_gains(std::span(&object, 1), skin_medium(), {.walks_per_mm2 = 0}));
}

TEST(VertexGain, MapHasTheVerticesValues) {
    const SceneObject object = ball(4);
    BakeMapSettings settings{.kind = MapKind::gain, .size = 64};
    EXPECT_EQ(bake_map(std::span(&object, 1), settings).error().message, "gain needs a diffusion profile");
    settings.profile = *find_profile("openpbr_skin_3");
    const Result<BakedMap> map = bake_map(std::span(&object, 1), settings);
    ASSERT_TRUE(map) << map.error().message;
    const Spread vertices = spread_of(gains_of(object).gains[0]);
    EXPECT_EQ(map->values.channels, 3);
    EXPECT_NEAR(map->values.at(32, 32, 0), vertices.mean.x, 0.05);
    EXPECT_NEAR(map->values.at(32, 32, 2), vertices.mean.z, 0.05);
    EXPECT_GT(map->noise.x, 0);
    EXPECT_LT(map->noise.x, 0.02f);
}

TEST(VertexGain, MapFileIsDescribedByItsSidecar) {
    const SceneObject object = ball(4);
    BakeMapSettings settings{.kind = MapKind::gain, .size = 32, .profile = *find_profile("openpbr_skin_3")};
    const Result<BakedMap> map = bake_map(std::span(&object, 1), settings);
    ASSERT_TRUE(map) << map.error().message;
    const TemporaryDirectory folder;
    const std::filesystem::path path = folder.path / "gain.exr";
    ASSERT_TRUE(write_map(path, *map, {"ball.obj", settings}));
    EXPECT_EQ(**describe_map(path),
              "a map of gain over the UVs of ball.obj, unit 1, 32x32, for profile openpbr_skin_3");
    std::filesystem::rename(map_sidecar_path(path), folder.path / "other.exr.json");
    EXPECT_FALSE(*describe_map(path)) << "no sidecar";
    settings.size = 16;
    const Result<BakedMap> small = bake_map(std::span(&object, 1), settings);
    ASSERT_TRUE(small && write_map(path, *small, {"ball.obj", settings}));
    std::filesystem::rename(folder.path / "other.exr.json", map_sidecar_path(path));
    EXPECT_FALSE(describe_map(path)) << "not the picture of its sidecar";
}

}  // namespace
}  // namespace dermis
