// What counts across a gap, on two spheres that touch or nearly touch. `surface` counts the straight distance
// to all skin, through flesh or through space; `walk` counts paths through flesh alone: light that has left
// does not enter again. What is not skin counts in neither.

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/presets.h"
#include "dermis/reference/picture.h"
#include "dermis/reference/surface_integrator.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

constexpr float kLeftRadiusMm = 4;
constexpr double kVarianceMm2 = 3;

// The left sphere touches x = 0, the right one begins a gap further on.
Scene two_spheres(float gap_mm, float right_radius_mm, MaterialClass right, Vec3 to_light) {
    Scene scene;
    scene.objects.push_back({.name = "left",
                             .mesh = test::moved(test::sphere(kLeftRadiusMm, 5), {-kLeftRadiusMm, 0, 0}),
                             .classes = {MaterialClass::skin}});
    scene.objects.push_back(
        {.name = "right",
         .mesh = test::moved(test::sphere(right_radius_mm, 5), {gap_mm + right_radius_mm, 0, 0}),
         .classes = {right}});
    scene.lights.push_back({.intensity = 1, .to_light_world = to_light, .is_key = true});
    scene.camera = {.eye_mm = {0, 0, 80}, .vertical_fov_rad = 0.15f, .near_mm = 1, .far_mm = 200};
    scene.environment.kind = EnvironmentKind::none;
    scene.skin.profile = "jensen_skin1";
    return scene;
}

Estimate estimate_at(const Scene& scene, Vec3 p_mm, Vec3 n) {
    const RayScene rays = std::move(*RayScene::build(scene.objects));
    const MaterialSet materials = std::move(*MaterialSet::load(scene));
    const EnvironmentSampler environment = std::move(*EnvironmentSampler::load(scene.environment));
    const Lighting lighting(scene, rays, materials, environment, {});
    const Profile profile{
        .name = "test", .source = {}, .model = GaussianSum{"test", {{kVarianceMm2, {1, 1, 1}}}}};
    const SurfaceIntegrator integrator(rays, materials, lighting, ProfileSampler(profile, 1), {.probes = 64});
    return estimate_exitance(integrator, {p_mm, n}, 400, 3);
}

// The integral as a plain sum over the triangles of skin. Light from above reaches the upper half of each
// sphere, as neither is over the other.
double sum_over_triangles(const Scene& scene, Vec3 p_mm) {
    double above = 0, below = 0;
    for (const SceneObject& object : scene.objects) {
        if (object.classes[0] != MaterialClass::skin) continue;
        const Mesh& mesh = object.mesh;
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const uint32_t* c = &mesh.indices[i];
            const Vec3 a = mesh.positions_mm[c[0]], u = mesh.positions_mm[c[1]] - a,
                       v = mesh.positions_mm[c[2]] - a, middle = a + (u + v) * (1.0f / 3);
            const Vec3 n = normalize(mesh.normals[c[0]] + mesh.normals[c[1]] + mesh.normals[c[2]]);
            const Vec3 offset = middle - p_mm;
            const double weight = std::exp(-dot(offset, offset) / (2 * kVarianceMm2)) * length(cross(u, v));
            above += weight * std::max(0.0f, n.y);
            below += weight;
        }
    }
    return above / below;
}

}  // namespace

TEST(AcrossAGap, surface_counts_the_straight_distance_to_the_other_sphere) {
    const Scene touching = two_spheres(0, kLeftRadiusMm, MaterialClass::skin, {0, 1, 0}),
                beside_black = two_spheres(0, kLeftRadiusMm, MaterialClass::other, {0, 1, 0});
    double change = 0;
    for (const float angle_rad : {-0.9f, 0.2f, 0.9f}) {
        const Vec3 n = {std::cos(angle_rad), std::sin(angle_rad), 0},
                   p_mm = Vec3{-kLeftRadiusMm, 0, 0} + n * kLeftRadiusMm;
        const Estimate both = estimate_at(touching, p_mm, n), alone = estimate_at(beside_black, p_mm, n);
        const double expected = sum_over_triangles(touching, p_mm),
                     expected_alone = sum_over_triangles(beside_black, p_mm);
        EXPECT_NEAR(both.mean.x, expected, 4.5 * both.standard_error.x + 1e-3) << angle_rad;
        EXPECT_NEAR(alone.mean.x, expected_alone, 4.5 * alone.standard_error.x + 1e-3) << angle_rad;
        EXPECT_LT(both.standard_error.x, 0.003);
        change = std::max(change, std::abs(expected - expected_alone));
    }
    EXPECT_GT(change, 0.02) << "the other sphere is not seen in these points";
}

// Light from the left, and the right sphere wholly in the shadow of the left one.
TEST(AcrossAGap, walk_lets_no_light_cross_and_surface_does) {
    const Scene scene = two_spheres(0.2f, 0.75f * kLeftRadiusMm, MaterialClass::skin, {-1, 0, 0});
    for (const Integrator integrator : {Integrator::surface, Integrator::walk}) {
        ReferenceSettings settings{
            .integrator = integrator, .width = 16, .height = 16, .samples = 8, .probes = 64};
        settings.lighting.specular = SpecularReflection::none;
        const auto picture = render_reference(scene, settings);
        ASSERT_TRUE(picture) << picture.error().message;
        double left = 0, right = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) (x < 8 ? left : right) += picture->diffuse.at(x, y, 0);
        EXPECT_GT(left, 1);
        if (integrator == Integrator::surface) EXPECT_GT(right, 0.01 * left);
        if (integrator == Integrator::walk) EXPECT_EQ(right, 0);
    }
}

}  // namespace dermis
