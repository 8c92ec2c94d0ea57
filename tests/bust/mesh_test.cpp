#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bust/standard_bust.h"

namespace dermis {
namespace {

TEST(BustMesh, IsAClosedManifoldOfGenusZeroOnceItsSeamsAreWelded) {
    const Mesh& mesh = standard_bust().mesh;
    const std::vector<uint32_t> id = welded(mesh);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    std::set<uint32_t> vertices;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for (int k = 0; k < 3; ++k) {
            const uint32_t a = id[mesh.indices[i + k]], b = id[mesh.indices[i + (k + 1) % 3]];
            ++edges[{a, b}];
            vertices.insert(a);
        }
    size_t unpaired = 0;
    for (const auto& [edge, count] : edges)
        unpaired += count != 1 || !edges.contains({edge.second, edge.first});
    EXPECT_EQ(unpaired, 0u);
    EXPECT_EQ(long(vertices.size()) - long(edges.size() / 2) + long(mesh.triangle_count()), 2);
}

TEST(BustMesh, HasNoTriangleWithoutAreaAndAsManyAsPromised) {
    const Mesh& mesh = standard_bust().mesh;
    EXPECT_GE(mesh.triangle_count(), 60000u);
    EXPECT_LE(mesh.triangle_count(), 200000u);
    double least_mm2 = 1e9, volume = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3 a = mesh.positions_mm[mesh.indices[i]], b = mesh.positions_mm[mesh.indices[i + 1]],
                   c = mesh.positions_mm[mesh.indices[i + 2]];
        least_mm2 = std::min(least_mm2, 0.5 * double(length(cross(b - a, c - a))));
        volume += double(dot(a, cross(b, c))) / 6;
    }
    EXPECT_GT(least_mm2, 1e-4);
    EXPECT_GT(volume, 4e6);  // outward faces; head, neck and chest hold some six litres
}

TEST(BustMesh, LiesOnItsFieldWithTheFieldsNormals) {
    const Mesh& mesh = standard_bust().mesh;
    double worst_mm = 0, worst_cosine = 1;
    for (size_t i = 0; i < mesh.positions_mm.size(); i += 37) {
        const Vec3 p = mesh.positions_mm[i], n = mesh.normals[i];
        const bust::Point at = {p.x, p.y, p.z}, normal = standard_field().normal(at);
        worst_mm = std::max(worst_mm, std::abs(standard_field().distance_mm(at)));
        worst_cosine = std::min(worst_cosine, normal.x * n.x + normal.y * n.y + normal.z * n.z);
    }
    EXPECT_LT(worst_mm, 0.5);
    EXPECT_GT(worst_cosine, 0.999);
}

}  // namespace
}  // namespace dermis
