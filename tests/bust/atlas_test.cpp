#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bust/standard_bust.h"

namespace dermis {
namespace {

constexpr int kSide = 2048;

double doubled_area(Vec2 a, Vec2 b, Vec2 c) {
    return double(b.x - a.x) * (c.y - a.y) - double(b.y - a.y) * (c.x - a.x);
}

/// Calls body(x, y) for every texel of a 2048 atlas whose middle lies inside the triangle by a margin.
template <class Body>
void for_each_texel(const Mesh& mesh, size_t first_index, Body body) {
    Vec2 p[3];
    for (int k = 0; k < 3; ++k) p[k] = mesh.uvs[mesh.indices[first_index + k]] * float(kSide);
    const double area = doubled_area(p[0], p[1], p[2]);
    if (std::abs(area) < 1e-9) return;
    const int x0 = int(std::min({p[0].x, p[1].x, p[2].x})), x1 = int(std::max({p[0].x, p[1].x, p[2].x}));
    const int y0 = int(std::min({p[0].y, p[1].y, p[2].y})), y1 = int(std::max({p[0].y, p[1].y, p[2].y}));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const Vec2 q = {float(x) + 0.5f, float(y) + 0.5f};
            const double least =
                std::min({doubled_area(p[1], p[2], q) / area, doubled_area(p[2], p[0], q) / area,
                          doubled_area(p[0], p[1], q) / area});
            if (least > 1e-4) body(x, y);
        }
}

/// Which piece of the atlas a vertex belongs to: triangles that share a vertex are of one piece.
std::vector<uint32_t> pieces(const Mesh& mesh) {
    std::vector<uint32_t> root(mesh.uvs.size());
    for (uint32_t i = 0; i < root.size(); ++i) root[i] = i;
    const auto find = [&](uint32_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for (int k = 1; k < 3; ++k) root[find(mesh.indices[i + k])] = find(mesh.indices[i]);
    for (uint32_t i = 0; i < root.size(); ++i) root[i] = find(i);
    return root;
}

TEST(BustAtlas, LiesWithinTheSquareAndTurnsEveryTriangleTheSameWay) {
    const Mesh& mesh = standard_bust().mesh;
    for (const Vec2 uv : mesh.uvs) {
        ASSERT_GT(std::min(uv.x, uv.y), 0);
        ASSERT_LT(std::max(uv.x, uv.y), 1);
    }
    size_t turned = 0, flat = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const double area = doubled_area(mesh.uvs[mesh.indices[i]], mesh.uvs[mesh.indices[i + 1]],
                                         mesh.uvs[mesh.indices[i + 2]]);
        turned += area > 1e-12;
        flat += std::abs(area) <= 1e-12;
    }
    EXPECT_EQ(turned, 0u);  // v runs down, so fronts are clockwise
    EXPECT_EQ(flat, 0u);
}

TEST(BustAtlas, NoTexelBelongsToTwoTriangles) {
    const Mesh& mesh = standard_bust().mesh;
    std::vector<uint8_t> taken(size_t(kSide) * kSide, 0);
    size_t twice = 0, covered = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for_each_texel(mesh, i, [&](int x, int y) {
            uint8_t& t = taken[size_t(y) * kSide + x];
            twice += t;
            covered += !t;
            t = 1;
        });
    EXPECT_EQ(twice, 0u);
    EXPECT_GT(double(covered) / double(taken.size()), 0.7);
}

TEST(BustAtlas, PiecesStayEightTexelsApartAndOffTheBorder) {
    const Mesh& mesh = standard_bust().mesh;
    const std::vector<uint32_t> piece = pieces(mesh);
    std::vector<uint32_t> owner(size_t(kSide) * kSide, UINT32_MAX);
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for_each_texel(mesh, i, [&](int x, int y) { owner[size_t(y) * kSide + x] = piece[mesh.indices[i]]; });
    size_t too_near = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const uint32_t mine = owner[size_t(y) * kSide + x];
            if (mine == UINT32_MAX) continue;
            too_near += x < 8 || y < 8 || x >= kSide - 8 || y >= kSide - 8;
            for (int d = 1; d <= 8; ++d)
                for (const auto& [dx, dy] :
                     {std::pair{d, 0}, std::pair{0, d}, std::pair{d, d}, std::pair{-d, d}}) {
                    const int px = x + dx, py = y + dy;
                    if (px < 0 || px >= kSide || py >= kSide) continue;
                    const uint32_t other = owner[size_t(py) * kSide + px];
                    too_near += other != UINT32_MAX && other != mine;
                }
        }
    EXPECT_EQ(too_near, 0u);
}

TEST(BustAtlas, StretchesLessThanTwoAndAHalfAtTheNinetyFifthPercentile) {
    const Mesh& mesh = standard_bust().mesh;
    struct Face {
        double anisotropy, area;
    };
    std::vector<Face> faces;
    double total = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t* t = &mesh.indices[i];
        const Vec3 e = mesh.positions_mm[t[1]] - mesh.positions_mm[t[0]],
                   f = mesh.positions_mm[t[2]] - mesh.positions_mm[t[0]];
        const Vec2 a = mesh.uvs[t[1]] - mesh.uvs[t[0]], b = mesh.uvs[t[2]] - mesh.uvs[t[0]];
        // First fundamental form of uv over the surface, by its trace and determinant.
        const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), det = ee * ff - ef * ef;
        const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
        const double trace = (aa * ff - 2 * ab * ef + bb * ee) / det, product = (aa * bb - ab * ab) / det;
        const double root = std::sqrt(std::max(0.0, trace * trace / 4 - product));
        const double area = 0.5 * std::sqrt(det);
        faces.push_back({std::sqrt((trace / 2 + root) / std::max(trace / 2 - root, 1e-30)), area});
        total += area;
    }
    std::sort(faces.begin(), faces.end(),
              [](const Face& p, const Face& q) { return p.anisotropy < q.anisotropy; });
    double sum = 0;
    size_t k = 0;
    while (k < faces.size() && sum < 0.95 * total) sum += faces[k++].area;
    EXPECT_LT(faces[k - 1].anisotropy, 2.5);
}

}  // namespace
}  // namespace dermis
