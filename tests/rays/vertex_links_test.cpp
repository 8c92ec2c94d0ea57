#include "dermis/rays/vertex_links.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dermis/mesh/primitives.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/curvature_gain.h"

namespace dermis {
namespace {

const Profile& skin() {
    static const Profile kSkin = *find_profile("openpbr_skin_3");
    return kSkin;
}

SceneObject ball_of_skin(float radius_mm) {
    return {.name = "ball", .mesh = make_sphere(radius_mm, 32), .classes = {MaterialClass::skin}};
}

VertexLinks links_of(std::span<const SceneObject> objects, const VertexLinkSettings& settings = {}) {
    Result<VertexLinks> walked =
        walk_vertex_links(objects, walk_medium_of(skin()), to_gaussian_sum(skin()).sum, settings);
    EXPECT_TRUE(walked) << walked.error().message;
    return *walked;
}

Vec3 sum_of_row(const VertexLinks& links, uint32_t row) {
    Vec3 sum;
    for (uint32_t l = links.first[row]; l < links.first[row + 1]; ++l) sum += links.links[l].weight;
    return sum;
}

// What vertices get of a light of each vertex, and its mean over those with links.
Vec3 mean_added(const VertexLinks& links, const auto& light) {
    Vec3 sum;
    int count = 0;
    for (uint32_t r = 1; r + 1 < links.first.size(); ++r, ++count)
        for (uint32_t l = links.first[r]; l < links.first[r + 1]; ++l)
            sum += links.links[l].weight * light(links.links[l].vertex);
    return sum * (1 / float(count));
}

TEST(VertexLinks, BringTheGainOfABallUnderEvenLight) {
    const SceneObject object = ball_of_skin(4);
    const Vec3 mean = mean_added(links_of(std::span(&object, 1)), [](uint32_t) { return 1.0f; });
    const WalkedGains expected = walk_gain(walk_medium_of(skin()), std::array{0.25}, 1 << 17, 3);
    EXPECT_NEAR(mean.x, expected.samples[0].gain[0] - 1, 0.015);
    EXPECT_NEAR(mean.y, expected.samples[0].gain[1] - 1, 0.015);
    EXPECT_NEAR(mean.z, expected.samples[0].gain[2] - 1, 0.015);
}

// The walks of one vertex lead through the body, the profile stays on its side.
TEST(VertexLinks, BringLightThroughABallFromItsFarSide) {
    const SceneObject object = ball_of_skin(2);
    const VertexLinks links = links_of(std::span(&object, 1));
    const std::vector<Vec3>& places = object.mesh.positions_mm;
    Vec3 far;
    int count = 0;
    for (size_t v = 0; v < places.size(); ++v) {
        if (places[v].y < 1.8f) continue;
        const uint32_t row = links.rows[0][v];
        for (uint32_t l = links.first[row]; l < links.first[row + 1]; ++l)
            if (places[links.links[l].vertex].y < -0.5f) far += links.links[l].weight;
        ++count;
    }
    EXPECT_GT(far.x / float(count), 0.015f);
    EXPECT_GT(far.x, 3 * far.z);
}

TEST(VertexLinks, OfNearlyFlatSkinHaveLittleNoise) {
    const SceneObject object{.name = "ball", .mesh = make_sphere(30, 96), .classes = {MaterialClass::skin}};
    const VertexLinks links = links_of(std::span(&object, 1));
    const WalkedGains expected = walk_gain(walk_medium_of(skin()), std::array{1 / 30.0}, 1 << 18, 3);
    Vec3 sum, squares;
    float count = 0;
    for (uint32_t r = 1; r + 1 < links.first.size(); ++r, ++count) {
        const Vec3 added = sum_of_row(links, r);
        sum += added, squares += added * added;
    }
    const float mean = sum.x / count;
    EXPECT_NEAR(mean, expected.samples[0].gain[0] - 1, 0.005);
    EXPECT_LT(std::sqrt(squares.x / count - mean * mean), 0.02f);
}

// Every triangle with vertices of its own, as along the seams of an atlas.
TEST(VertexLinks, OfVerticesAtOnePositionAreShared) {
    SceneObject object = ball_of_skin(4);
    const Mesh whole = object.mesh;
    Mesh& mesh = object.mesh;
    mesh.indices.clear(), mesh.positions_mm.clear(), mesh.normals.clear(), mesh.uvs.clear();
    for (const uint32_t v : whole.indices) {
        mesh.indices.push_back(uint32_t(mesh.positions_mm.size()));
        mesh.positions_mm.push_back(whole.positions_mm[v]);
        mesh.normals.push_back(whole.normals[v]);
    }
    const VertexLinks links = links_of(std::span(&object, 1), {.walks_per_mm2 = 1, .least_walks = 16});
    EXPECT_LE(links.first.size(), whole.positions_mm.size() + 2);
    for (size_t a = 0; a < 300; ++a)
        for (size_t b = 0; b < a; ++b)
            if (whole.indices[a] == whole.indices[b]) EXPECT_EQ(links.rows[0][a], links.rows[0][b]);
}

TEST(VertexLinks, LeadToOtherObjectsAndNotFromWhatIsNotSkin) {
    SceneObject objects[] = {ball_of_skin(4), ball_of_skin(4)};
    objects[1].classes = {MaterialClass::other};
    for (Vec3& p : objects[1].mesh.positions_mm) p.x += 20;
    const VertexLinks links = links_of(objects, {.walks_per_mm2 = 1, .least_walks = 16});
    for (const uint32_t row : links.rows[1]) EXPECT_EQ(row, 0u);
    const auto vertices = uint32_t(objects[0].mesh.positions_mm.size());
    for (const VertexLink& link : links.links) EXPECT_LT(link.vertex, vertices);
    EXPECT_EQ(links.first[0], links.first[1]);

    // A second ball of skin that overlaps the first: walks pass from one into the other.
    objects[1] = ball_of_skin(4);
    for (Vec3& p : objects[1].mesh.positions_mm) p.x += 3;
    const VertexLinks joined = links_of(objects, {.walks_per_mm2 = 1, .least_walks = 16});
    int across = 0;
    for (const uint32_t row : joined.rows[0])
        for (uint32_t l = joined.first[row]; l < joined.first[row + 1]; ++l)
            across += joined.links[l].vertex >= vertices;
    EXPECT_GT(across, 100);
}

TEST(VertexLinks, ThatAreLeftOutAreAddedToThoseKept) {
    const SceneObject object = ball_of_skin(4);
    const VertexLinks all = links_of(std::span(&object, 1), {.walks_per_mm2 = 4, .most_links = 1024});
    const VertexLinks few = links_of(std::span(&object, 1), {.walks_per_mm2 = 4, .most_links = 8});
    EXPECT_LE(few.links.size(), 8 * (few.first.size() - 1));
    ASSERT_EQ(all.first.size(), few.first.size());
    for (uint32_t r = 1; r + 1 < all.first.size(); ++r)
        EXPECT_NEAR(sum_of_row(all, r).x, sum_of_row(few, r).x, 1e-4);
}

// Merged links bring the wrong light where one side is lit and the other is dark.
TEST(VertexLinks, AreMoreWhereMoreLightComesThrough) {
    const auto mean_links = [](float radius_mm) {
        const SceneObject object = ball_of_skin(radius_mm);
        const VertexLinks links =
            links_of(std::span(&object, 1), {.walks_per_mm2 = 8, .least_walks = 256, .most_links = 1024});
        return double(links.links.size()) / double(links.first.size() - 2);
    };
    const double in_thin = mean_links(2), in_thick = mean_links(40);
    EXPECT_GT(in_thin, 3 * in_thick);
}

TEST(VertexLinks, RefuseSettingsOutOfRangeAndScenesWithoutSkin) {
    SceneObject object = ball_of_skin(4);
    const auto message = [&](const VertexLinkSettings& settings) {
        const Result<VertexLinks> walked = walk_vertex_links(std::span(&object, 1), walk_medium_of(skin()),
                                                             to_gaussian_sum(skin()).sum, settings);
        return walked ? std::string() : walked.error().message;
    };
    EXPECT_EQ(message({.walks_per_mm2 = 0}), "walks per mm^2 are 0, not within 0.1..10000");
    EXPECT_EQ(message({.least_walks = 0}), "the least walks of a vertex are 0, not within 1..1000000");
    EXPECT_EQ(message({.most_links = 0}), "the most links of a vertex are 0, not within 2..1024");
    object.classes = {MaterialClass::other};
    EXPECT_EQ(message({}), "there is no skin that returns light to the outside");
}

}  // namespace
}  // namespace dermis
