#include "dermis/mesh/curvature_stencils.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/mesh/curvature.h"
#include "dermis/mesh/primitives.h"

namespace dermis {
namespace {

// Vertices that are at least this far from the border of a plane of 20 x 20 mm.
bool is_inside(Vec3 p, float margin_mm) {
    return std::abs(p.x) < 10 - margin_mm && std::abs(p.y) < 10 - margin_mm;
}

// `plane` rolled around the Y axis, its x stretched before.
std::vector<Vec3> rolled(const Mesh& plane, float radius_mm, float stretch) {
    std::vector<Vec3> positions;
    for (const Vec3 p : plane.positions_mm) {
        const float angle = stretch * p.x / radius_mm;
        positions.push_back({radius_mm * std::sin(angle), p.y, radius_mm * (std::cos(angle) - 1)});
    }
    return positions;
}

}  // namespace

TEST(CurvatureStencils, of_a_plane_that_is_stretched_and_rolled_are_those_of_the_cylinder) {
    const Mesh plane = make_plane(20, 20, 20);
    const CurvatureStencils stencils(plane, kCurvatureSmoothingMm);
    for (const float stretch : {1.0f, 1.3f}) {
        const std::vector<Vec3> posed = rolled(plane, 12, stretch);
        for (uint32_t v = 0; v < posed.size(); ++v) {
            EXPECT_LE(stencils.around(v).size(), CurvatureStencils::kMostNeighbours);
            if (!is_inside(plane.positions_mm[v], 4)) continue;
            const float angle = stretch * plane.positions_mm[v].x / 12;
            const CurvatureTensor s = stencils.tensor(v, posed);
            const Vec3 around{std::cos(angle), 0, -std::sin(angle)};
            EXPECT_NEAR(dot(around, s * around), 1.0f / 12, 0.05f / 12) << v;
            EXPECT_NEAR(dot(Vec3{0, 1, 0}, s * Vec3{0, 1, 0}), 0, 0.01f / 12) << v;
            EXPECT_NEAR(mean_curvature(stencils.tensor(v, plane.positions_mm)), 0, 1e-5f) << v;
        }
    }
}

TEST(CurvatureStencils, turn_with_the_surface_and_fall_as_it_grows) {
    const Mesh sphere = make_sphere(10, 64);
    const CurvatureStencils stencils(sphere, kCurvatureSmoothingMm);
    std::vector<Vec3> turned;
    for (const Vec3 p : sphere.positions_mm) turned.push_back(Vec3{p.y, p.z, p.x} * 2);
    for (uint32_t v = 0; v < turned.size(); ++v) {
        const CurvatureTensor before = stencils.tensor(v, sphere.positions_mm),
                              after = stencils.tensor(v, turned);
        EXPECT_NEAR(mean_curvature(before), 0.1f, 0.005f) << v;
        EXPECT_NEAR(after.diagonal.x, before.diagonal.y / 2, 1e-4f) << v;
        EXPECT_NEAR(after.mixed.x, before.mixed.y / 2, 1e-4f) << v;
    }
}

}  // namespace dermis
