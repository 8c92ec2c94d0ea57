#include "dermis/mesh/hole_caps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace dermis {
namespace {

// A round opening in the plane z = 0 whose triangles lie outside of it and face +z; every second vertex is
// lifted by `wave`.
struct Rim {
    std::vector<Vec3> positions_mm;
    std::vector<uint32_t> indices, triangles;

    explicit Rim(int count, float wave = 0) {
        for (const float radius : {10.0f, 12.0f})
            for (int i = 0; i < count; ++i) {
                const float angle = 2 * std::numbers::pi_v<float> * float(i) / float(count);
                positions_mm.push_back(
                    {radius * std::cos(angle), radius * std::sin(angle), i % 2 == 0 ? 0 : wave});
            }
        const auto n = uint32_t(count);
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t j = (i + 1) % n;
            for (const uint32_t index : {i, n + i, j, j, n + i, n + j}) indices.push_back(index);
        }
        triangles.resize(indices.size() / 3);
        std::iota(triangles.begin(), triangles.end(), 0u);
    }
};

Vec3 area_vector(const std::vector<std::array<Vec3, 3>>& triangles) {
    Vec3 sum;
    for (const auto& [a, b, c] : triangles) sum += cross(b - a, c - a) * 0.5f;
    return sum;
}

double area_of(const std::vector<std::array<Vec3, 3>>& triangles) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles) sum += 0.5 * length(cross(b - a, c - a));
    return sum;
}

TEST(HoleCaps, a_ring_has_an_inner_and_an_outer_border) {
    const Rim rim(40);
    const auto loops = border_loops(rim.positions_mm, rim.indices, rim.triangles);
    ASSERT_EQ(loops.size(), 2u);
    EXPECT_EQ(loops[0].size(), 40u);
    EXPECT_EQ(loops[1].size(), 40u);
    EXPECT_NEAR(length(loops[0][0]), 10, 1e-4);
}

// Triangles that share nothing: a border each, moved along x.
std::vector<BorderLoop> loose_triangles(size_t count) {
    std::vector<BorderLoop> loops;
    for (size_t i = 0; i < count; ++i) {
        const auto x = float(i * 7919 % count);
        loops.push_back({{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
    }
    return loops;
}

struct CountedOrder {
    size_t* comparisons;
    bool operator()(const BorderLoop& a, const BorderLoop& b) const {
        ++*comparisons;
        return LoopOrder()(a, b);
    }
};

TEST(HoleCaps, borders_that_are_known_go_last_in_their_order) {
    std::vector<BorderLoop> loops = loose_triangles(7);
    const std::vector<BorderLoop> before = loops;
    EXPECT_EQ(put_last(loops, {before[4], before[1]}), 5u);
    const std::vector<BorderLoop> expected = {before[0], before[2], before[3], before[5],
                                              before[6], before[1], before[4]};
    EXPECT_EQ(loops, expected);
    EXPECT_EQ(put_last(loops, {}), 7u);
}

TEST(HoleCaps, work_grows_no_faster_than_n_log_n_with_the_number_of_borders) {
    for (const size_t count : {1000u, 100'000u}) {
        std::vector<BorderLoop> loops = loose_triangles(count);
        size_t comparisons = 0;
        EXPECT_EQ(put_last(loops, loose_triangles(count), CountedOrder{&comparisons}), 0u);
        EXPECT_LT(double(comparisons), 4 * double(count) * std::log2(double(count))) << count;
    }
}

TEST(HoleCaps, borders_that_meet_at_one_vertex_are_each_a_loop) {
    std::vector<Vec3> positions_mm = {{0, 0, 0}};
    std::vector<uint32_t> indices, triangles;
    const uint32_t count = 1000;
    for (uint32_t i = 0; i < count; ++i) {
        positions_mm.push_back({1, float(i), 0});
        positions_mm.push_back({1, float(i), 1});
        for (const uint32_t index : {0u, 2 * i + 1, 2 * i + 2}) indices.push_back(index);
        triangles.push_back(i);
    }
    const auto loops = border_loops(positions_mm, indices, triangles);
    ASSERT_EQ(loops.size(), count);
    for (const BorderLoop& loop : loops) EXPECT_EQ(loop.size(), 3u);
}

TEST(HoleCaps, thousands_of_long_borders_are_filled_in_bounded_time) {
    const Rim rim(200);
    const BorderLoop loop = border_loops(rim.positions_mm, rim.indices, rim.triangles)[0];
    EXPECT_EQ(affordable_exact(std::vector<BorderLoop>(100, loop)), kLargestExactLoop)
        << "a mesh as heads are";
    const size_t exact = affordable_exact(std::vector<BorderLoop>(100000, loop));
    EXPECT_LE(100000.0 * double(exact * exact * exact) / 6, 2e9);
    EXPECT_NEAR(area_of(cap_of(loop, exact)), area_of(cap_of(loop)), 1e-3 * area_of(cap_of(loop)));
}

TEST(HoleCaps, a_flat_opening_is_filled_once_and_faces_as_its_surface_does) {
    for (const int count : {3, 40, 1000}) {
        const Rim rim(count);
        const auto cap = cap_of(border_loops(rim.positions_mm, rim.indices, rim.triangles)[0]);
        const double polygon = 0.5 * count * 100 * std::sin(2 * std::numbers::pi / count);
        EXPECT_EQ(cap.size(), size_t(count - 2));
        EXPECT_NEAR(area_of(cap), polygon, 1e-3 * polygon) << count;
        EXPECT_NEAR(area_vector(cap).z, polygon, 1e-3 * polygon) << count;
    }
}

TEST(HoleCaps, a_cap_and_its_surface_leave_no_border_but_the_outer_one) {
    const Rim rim(30, 3);
    const auto loops = border_loops(rim.positions_mm, rim.indices, rim.triangles);
    std::vector<Vec3> positions = rim.positions_mm;
    std::vector<uint32_t> indices = rim.indices;
    for (const auto& triangle : cap_of(loops[0]))
        for (const Vec3 p : triangle) {
            indices.push_back(uint32_t(positions.size()));
            positions.push_back(p);
        }
    std::vector<uint32_t> all(indices.size() / 3);
    std::iota(all.begin(), all.end(), 0u);
    const auto rest = border_loops(positions, indices, all);
    ASSERT_EQ(rest.size(), 1u);
    EXPECT_NEAR(length(Vec3{rest[0][0].x, rest[0][0].y, 0}), 12, 1e-4);
}

TEST(HoleCaps, a_bent_slit_is_closed_along_itself) {
    // An arched slit, 40 long and 0.1 wide: the smallest cap is the strip, whatever the arch.
    BorderLoop loop;
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i <= 20; ++i) {
            const float t = float(side == 0 ? i : 20 - i) / 20 * 2 - 1;
            loop.push_back({20 * t, 8 * (1 - t * t) + (side == 0 ? 0.05f : -0.05f), 0});
        }
    EXPECT_LT(area_of(cap_of(loop)), 0.12 * 50);
}

TEST(HoleCaps, positions_shared_across_a_seam_are_no_border) {
    Rim rim(12);
    // The first triangle gets its own copies of its corners.
    for (int corner = 0; corner < 3; ++corner) {
        rim.positions_mm.push_back(rim.positions_mm[rim.indices[size_t(corner)]]);
        rim.indices[size_t(corner)] = uint32_t(rim.positions_mm.size() - 1);
    }
    EXPECT_EQ(border_loops(rim.positions_mm, rim.indices, rim.triangles).size(), 2u);
}

}  // namespace
}  // namespace dermis
