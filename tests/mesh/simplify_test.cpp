#include "dermis/mesh/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "dermis/mesh/primitives.h"
#include "dermis/mesh/topology.h"

using namespace dermis;

namespace {

constexpr float kRadiusMm = 10;
constexpr size_t kWanted = 700;

// Of each edge between positions, how many triangles have it in one direction.
std::map<std::pair<uint32_t, uint32_t>, int> directed_edges(const Mesh& mesh,
                                                            const std::vector<uint32_t>& indices) {
    const Weld weld = weld_positions(mesh.positions_mm);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint32_t a = weld.ids[indices[i]], b = weld.ids[indices[i % 3 == 2 ? i - 2 : i + 1]];
        if (a != b) ++edges[{a, b}];
    }
    return edges;
}

}  // namespace

TEST(Simplify, a_sphere_of_fewer_triangles_is_closed_and_of_the_same_size) {
    const Mesh mesh = make_sphere(kRadiusMm, 96);
    ASSERT_GT(mesh.triangle_count(), 3 * kWanted);
    const SimplifiedTriangles made = simplify(mesh, kWanted);
    EXPECT_LE(made.indices.size() / 3, kWanted);
    EXPECT_GT(made.indices.size() / 3, kWanted - 3);
    const auto edges = directed_edges(mesh, made.indices);
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first})) << edge.first;
    }
    for (size_t t = 0; t < made.indices.size(); t += 3) {
        const auto p = [&](size_t k) { return mesh.positions_mm[made.indices[t + k]]; };
        const Vec3 center = (p(0) + p(1) + p(2)) * (1 / 3.0f), n = cross(p(1) - p(0), p(2) - p(0));
        EXPECT_GT(length(center), 0.93f * kRadiusMm);
        EXPECT_GE(dot(center, n), 0);
    }
}

TEST(Simplify, vertices_on_uv_seams_stay) {
    const Mesh mesh = make_sphere(kRadiusMm, 96);
    const SimplifiedTriangles made = simplify(mesh, kWanted);
    const auto on_seam = [&](const std::vector<uint32_t>& indices) {
        const Weld weld = weld_positions(mesh.positions_mm);
        std::map<uint32_t, std::set<uint32_t>> copies;
        for (const uint32_t v : indices) copies[weld.ids[v]].insert(v);
        return std::ranges::count_if(copies, [](const auto& one) { return one.second.size() > 1; });
    };
    EXPECT_GT(on_seam(mesh.indices), 40);
    EXPECT_EQ(on_seam(made.indices), on_seam(mesh.indices));
}

TEST(Simplify, submeshes_keep_their_materials_and_cover_all_triangles) {
    Mesh mesh = make_sphere(kRadiusMm, 96);
    const auto half = uint32_t(mesh.indices.size() / 6 * 3);
    mesh.submeshes = {{.name = "upper", .first_index = 0, .index_count = half, .material = 1},
                      {.name = "lower",
                       .first_index = half,
                       .index_count = uint32_t(mesh.indices.size()) - half,
                       .material = 0}};
    const SimplifiedTriangles made = simplify(mesh, kWanted);
    ASSERT_EQ(made.submeshes.size(), 2u);
    EXPECT_EQ(made.submeshes[0].name, "upper");
    EXPECT_EQ(made.submeshes[0].material, 1u);
    EXPECT_EQ(made.submeshes[1].first_index, made.submeshes[0].index_count);
    EXPECT_EQ(made.submeshes[0].index_count + made.submeshes[1].index_count, made.indices.size());
}

TEST(Simplify, a_mesh_that_is_small_enough_stays) {
    const Mesh mesh = make_sphere(kRadiusMm, 16);
    EXPECT_EQ(simplify(mesh, mesh.triangle_count()).indices, mesh.indices);
    EXPECT_TRUE(simplify(Mesh(), 10).indices.empty());
}
