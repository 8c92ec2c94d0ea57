#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "dermis/mesh/curvature.h"
#include "dermis/mesh/normals.h"
#include "dermis/mesh/primitives.h"
#include "dermis/mesh/topology.h"
#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

// Largest error relative to the surface's largest curvature, over vertices that are not within `margin` of
// the first or last row (open borders see one side only).
double worst_relative_error(const Mesh& mesh, const std::vector<float>& curvatures, float margin = 0) {
    double largest = 0, worst = 0;
    for (const CurvatureTensor& s : mesh.curvatures_per_mm)
        largest = std::max(largest, std::abs(double(mean_curvature(s))));
    for (size_t i = 0; i < curvatures.size(); ++i)
        if (mesh.uvs[i].y >= margin && mesh.uvs[i].y <= 1 - margin)
            worst = std::max(
                worst, std::abs(double(curvatures[i]) - mean_curvature(mesh.curvatures_per_mm[i])) / largest);
    return worst;
}

}  // namespace

TEST(Curvature, of_a_sphere_is_its_inverse_radius_everywhere) {
    for (const float radius_mm : {2.0f, 8.0f, 80.0f}) {
        const Mesh mesh = make_sphere(radius_mm, 96);
        EXPECT_LT(worst_relative_error(mesh, compute_curvature(mesh)), 0.005) << radius_mm;
    }
}

TEST(Curvature, of_a_sphere_needs_no_fine_tessellation) {
    const Mesh mesh = make_sphere(10, 24);
    EXPECT_LT(worst_relative_error(mesh, compute_curvature(mesh)), 0.002);
}

TEST(Curvature, does_not_depend_on_the_vertex_normals) {
    Mesh mesh = make_sphere(10, 96);
    for (Vec3& n : mesh.normals) n = normalize(n + Vec3{0.3f, 0.2f, -0.1f});
    EXPECT_LT(worst_relative_error(mesh, compute_curvature(mesh)), 0.005);
}

TEST(Curvature, of_one_side_of_a_thin_fold_does_not_include_the_other) {
    // A strip bent back onto itself, 1 mm thick; 3 mm from the bend its sides are flat.
    Mesh mesh = make_plane(20, 10, 40);
    for (Vec3& p : mesh.positions_mm)
        if (p.x > 0) p = {-p.x, p.y, -1};
    compute_normals(mesh);
    const std::vector<float> curvatures = compute_curvature(mesh, 2.5);
    for (size_t i = 0; i < curvatures.size(); ++i)
        if (mesh.positions_mm[i].x < -3) {
            EXPECT_NEAR(curvatures[i], 0, 0.002);
        }
}

TEST(Curvature, of_a_torus_and_a_cylinder_follows_the_formula) {
    const Mesh torus = make_torus(30, 10, 192);
    EXPECT_LT(worst_relative_error(torus, compute_curvature(torus)), 0.01);
    const Mesh cylinder = make_cylinder(10, 40, 96);
    EXPECT_LT(worst_relative_error(cylinder, compute_curvature(cylinder), 0.1f), 0.01);
}

TEST(Curvature, tensor_of_a_torus_has_both_principal_curvatures) {
    const Mesh mesh = make_torus(30, 10, 192);
    const std::vector<CurvatureTensor> tensors = compute_curvature_tensors(mesh);
    for (size_t i = 0; i < tensors.size(); ++i) {
        const Vec3 p = mesh.positions_mm[i], n = mesh.normals[i];
        const float to_axis_mm = std::hypot(p.x, p.z);
        const Vec3 along = {-p.z / to_axis_mm, 0, p.x / to_axis_mm}, around = cross(n, along);
        // 1/r around the tube; along it cos / (R + r cos), negative on the inside.
        const float cosine = (to_axis_mm - 30) / 10;
        EXPECT_NEAR(dot(around, tensors[i] * around), 0.1, 0.002);
        EXPECT_NEAR(dot(along, tensors[i] * along), cosine / to_axis_mm, 0.002);
        EXPECT_NEAR(dot(along, tensors[i] * around), 0, 0.001);
        EXPECT_LT(length(tensors[i] * n), 0.003);
    }
}

TEST(Curvature, tensor_of_a_catenoid_is_a_saddles) {
    Mesh catenoid = make_cylinder(1, 2, 96);
    for (Vec3& p : catenoid.positions_mm) {
        const float r = std::cosh(p.y);
        p.x *= r, p.z *= r;
    }
    compute_normals(catenoid);
    const std::vector<CurvatureTensor> tensors = compute_curvature_tensors(catenoid);
    for (size_t i = 0; i < tensors.size(); ++i) {
        const Vec3 p = catenoid.positions_mm[i];
        if (std::abs(p.y) > 0.8f) continue;
        const float r = std::cosh(p.y);
        const Vec3 around = {-p.z / r, 0, p.x / r}, along = cross(catenoid.normals[i], around);
        EXPECT_NEAR(dot(around, tensors[i] * around), 1 / (r * r), 0.02);
        EXPECT_NEAR(dot(along, tensors[i] * along), -1 / (r * r), 0.02);
    }
}

TEST(Curvature, converges_with_the_square_of_the_edge_length) {
    const Mesh coarse = make_torus(30, 10, 80), fine = make_torus(30, 10, 160);
    const double ratio = worst_relative_error(coarse, compute_curvature(coarse)) /
                         worst_relative_error(fine, compute_curvature(fine));
    EXPECT_GT(ratio, 3.5);
    EXPECT_LT(ratio, 5);
}

TEST(Curvature, of_a_plane_and_of_a_catenoid_is_zero) {
    const Mesh plane = make_plane(10, 10, 10);
    for (const float h : compute_curvature(plane)) EXPECT_NEAR(h, 0, 1e-6);
    // A minimal surface: r = cosh y. Bend a cylinder into it.
    Mesh catenoid = make_cylinder(1, 2, 96);
    for (Vec3& p : catenoid.positions_mm) {
        const float r = std::cosh(p.y);
        p.x *= r, p.z *= r;
    }
    compute_normals(catenoid);
    const std::vector<float> curvatures = compute_curvature(catenoid);
    for (size_t i = 0; i < curvatures.size(); ++i)
        if (std::abs(catenoid.positions_mm[i].y) < 0.8f) {
            EXPECT_NEAR(curvatures[i], 0, 0.01);
        }
}

TEST(Curvature, is_negative_where_the_surface_is_concave) {
    Mesh bowl = make_sphere(5, 48);
    for (Vec3& n : bowl.normals) n = -n;
    for (size_t i = 0; i < bowl.indices.size(); i += 3) std::swap(bowl.indices[i], bowl.indices[i + 1]);
    for (const float h : compute_curvature(bowl)) EXPECT_NEAR(h, -0.2, 0.003);
}

TEST(Curvature, does_not_depend_on_uv_seams) {
    const Mesh mesh = make_sphere(10, 64);
    const std::vector<float> curvatures = compute_curvature(mesh);
    std::map<float, float> left;  // by v
    for (size_t i = 0; i < curvatures.size(); ++i)
        if (mesh.uvs[i].x == 0) left[mesh.uvs[i].y] = curvatures[i];
    size_t compared = 0;
    for (size_t i = 0; i < curvatures.size(); ++i)
        if (mesh.uvs[i].x == 1 && left.contains(mesh.uvs[i].y)) {
            EXPECT_EQ(left[mesh.uvs[i].y], curvatures[i]);
            ++compared;
        }
    EXPECT_EQ(compared, 31u);
    Mesh unwelded;  // every triangle its own vertices
    for (const uint32_t i : mesh.indices) {
        unwelded.indices.push_back(uint32_t(unwelded.indices.size()));
        unwelded.positions_mm.push_back(mesh.positions_mm[i]);
        unwelded.normals.push_back(mesh.normals[i]);
    }
    const std::vector<float> again = compute_curvature(unwelded);
    for (size_t c = 0; c < mesh.indices.size(); ++c) EXPECT_NEAR(again[c], curvatures[mesh.indices[c]], 1e-4);
}

TEST(Curvature, scales_inversely_with_size) {
    Mesh mesh = make_torus(3, 1, 48);
    const std::vector<float> small = compute_curvature(mesh);
    for (Vec3& p : mesh.positions_mm) p *= 10;
    const std::vector<float> large = compute_curvature(mesh);
    for (size_t i = 0; i < small.size(); ++i) EXPECT_NEAR(small[i], 10 * large[i], 1e-4);
}

TEST(Curvature, smoothing_averages_noise_away) {
    Mesh mesh = make_sphere(80, 200);
    std::mt19937 random(3);
    std::normal_distribution<float> noise_mm(0, 0.05f);
    const Weld weld = weld_positions(mesh.positions_mm);
    std::vector<float> noise(weld.count());
    for (float& n : noise) n = noise_mm(random);
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i)
        mesh.positions_mm[i] += mesh.normals[i] * noise[weld.ids[i]];
    const auto typical_error = [&](double smoothing_mm) {
        const std::vector<float> curvatures = compute_curvature(mesh, smoothing_mm);
        double sum = 0;
        for (const float h : curvatures) sum += (h * 80 - 1) * (h * 80 - 1);
        return std::sqrt(sum / double(curvatures.size()));
    };
    EXPECT_GT(typical_error(0), 0.5);
    EXPECT_LT(typical_error(5), 0.1);
}

TEST(Curvature, smoothing_keeps_a_spheres_curvature) {
    const Mesh mesh = make_sphere(20, 96);
    for (const float h : compute_curvature(mesh, 2)) EXPECT_NEAR(h * 20, 1, 0.02);
}

TEST(Curvature, surfaces_that_touch_do_not_mix) {
    // Two planes 0.01 mm apart, back to back, as closed lips are.
    Mesh mesh = make_plane(10, 10, 10), back = mesh;
    for (Vec3& p : back.positions_mm) p.z = -0.01f;
    for (Vec3& n : back.normals) n = -n;
    const auto first = uint32_t(mesh.positions_mm.size());
    mesh.positions_mm.insert(mesh.positions_mm.end(), back.positions_mm.begin(), back.positions_mm.end());
    mesh.normals.insert(mesh.normals.end(), back.normals.begin(), back.normals.end());
    for (size_t i = 0; i < back.indices.size(); i += 3)
        for (const size_t k : {0, 2, 1}) mesh.indices.push_back(first + back.indices[i + k]);
    for (const float h : compute_curvature(mesh, 2)) EXPECT_NEAR(h, 0, 1e-5);
}

TEST(Curvature, of_degenerate_meshes_is_finite) {
    Mesh mesh;
    mesh.positions_mm = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.indices = {0, 1, 2, 0, 0, 0, 3, 1, 2};
    for (const double smoothing_mm : {0.0, 1.0})
        for (const float h : compute_curvature(mesh, smoothing_mm)) EXPECT_EQ(h, 0);
}

TEST(Curvature, of_the_scanned_head_lies_where_a_heads_does) {
    if (!std::filesystem::exists(asset("lee_perry_smith/head.obj"))) GTEST_SKIP() << "no test head here";
    const auto loaded = read_mesh(asset("lee_perry_smith/head.obj"), {.unit_mm = 45});
    ASSERT_TRUE(loaded);
    std::vector<float> curvatures = compute_curvature(loaded->mesh, 2);
    std::ranges::sort(curvatures);
    const float median = curvatures[curvatures.size() / 2];
    EXPECT_GT(median, 0.002f) << "most of a head is convex";
    EXPECT_LT(median, 0.03f) << "with radii of several centimetres";
    EXPECT_LT(curvatures[curvatures.size() / 50], -0.01f) << "but not the corners of eyes and nose";
}
