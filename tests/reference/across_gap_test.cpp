// What counts across a gap: in both integrators the way through flesh alone. Light that has left the skin
// does not enter again. What is not skin counts in neither.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/optics/presets.h"
#include "dermis/rays/random.h"
#include "dermis/reference/picture.h"
#include "dermis/reference/surface_integrator.h"
#include "dermis/reference/way_through_flesh.h"
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
    const SurfaceIntegrator integrator(rays, lighting, ProfileSampler(profile, 1), {.probes_of_run = 21});
    const auto facet = rays.closest_hit(RaySet::skin, {.origin_mm = p_mm + n * 0.1f, .direction = -n});
    const DiffusePoint point = {rays.surface_at(*facet).p_world_mm, n, facet->n_face};
    return estimate_exitance(integrator, point, {}, 400, 3);
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

TEST(AcrossAGap, a_sphere_beside_it_counts_no_more_than_a_black_one) {
    const Scene beside_skin = two_spheres(0.2f, kLeftRadiusMm, MaterialClass::skin, {0, 1, 0}),
                beside_black = two_spheres(0.2f, kLeftRadiusMm, MaterialClass::other, {0, 1, 0});
    for (const float angle_rad : {-0.3f, 0.3f, 0.9f}) {
        const Vec3 n = {std::cos(angle_rad), std::sin(angle_rad), 0},
                   p_mm = Vec3{-kLeftRadiusMm, 0, 0} + n * kLeftRadiusMm;
        const double expected = sum_over_triangles(beside_black, p_mm);
        for (const Scene* scene : {&beside_skin, &beside_black}) {
            const Estimate light = estimate_at(*scene, p_mm, n);
            EXPECT_NEAR(light.mean.x, expected, 4.5 * light.standard_error.x + 1e-3) << angle_rad;
            EXPECT_LT(light.standard_error.x, 0.003);
        }
    }
}

// Light from the left, and the right sphere wholly in the shadow of the left one.
TEST(AcrossAGap, no_light_crosses_to_another_body) {
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
        // The straight distance gave 0.01; a few ways that only touch a facet remain.
        EXPECT_LT(right, 0.001 * left) << int(integrator);
    }
}

namespace {

// What leaves the dark wall of a groove whose other wall is lit, over its height from the bottom up.
std::vector<double> dark_wall(Integrator integrator, float half_angle_deg) {
    constexpr float side_mm = 120, depth_mm = 30;
    const float half_angle_rad = half_angle_deg * std::numbers::pi_v<float> / 180,
                s = std::sin(half_angle_rad), c = std::cos(half_angle_rad);
    Scene scene;
    scene.objects.push_back({.name = "block",
                             .mesh = test::grooved_block(side_mm, depth_mm, half_angle_rad),
                             .classes = {MaterialClass::skin}});
    // Along the left wall, so that the right one is lit to the bottom, and the left one not at all.
    scene.lights.push_back(
        {.intensity = 1, .to_light_world = normalize(Vec3{-1.01f * s, c, 0}), .is_key = true});
    const Vec3 middle = {-0.5f * depth_mm * s / c, -0.5f * depth_mm, 0};
    const float height_mm = depth_mm / c * std::sin(2 * half_angle_rad), eye_mm = 50 * depth_mm;
    scene.camera = {.eye_mm = middle + Vec3{s, c, 0} * eye_mm,
                    .target_mm = middle,
                    .up_world = {0, 0, 1},
                    .vertical_fov_rad = 2 * std::atan(0.5f * height_mm / eye_mm),
                    .near_mm = 1,
                    .far_mm = 2 * eye_mm};
    scene.environment.kind = EnvironmentKind::none;
    scene.skin.profile = "openpbr_skin_5";
    ReferenceSettings settings{
        .integrator = integrator, .width = 16, .height = 16, .samples = 64, .probes = 64};
    settings.lighting.specular = SpecularReflection::none;
    settings.lighting.penumbra_mm = 0;
    settings.cavities = Cavities::open;
    const auto picture = render_reference(scene, settings);
    EXPECT_TRUE(picture) << picture.error().message;
    std::vector<double> red(16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) red[size_t(x)] += picture->diffuse.at(x, y, 0) * std::numbers::pi / 16;
    return red;
}

}  // namespace

// Away from the wall's ends, where light comes around the edges. What is left there differs by the wedge that
// walks are in, which a profile does not know.
TEST(AcrossAGap, light_goes_around_the_bottom_of_a_groove) {
    for (const float angle_deg : {10.0f, 20.0f}) {
        const std::vector<double> surface = dark_wall(Integrator::surface, angle_deg),
                                  walk = dark_wall(Integrator::walk, angle_deg);
        for (size_t i = 2; i < 7; ++i) {
            const double up = (double(i) + 0.5) / 16;
            EXPECT_LT(surface[i], 0.04) << angle_deg << " degrees, at " << up << " of the wall";
            EXPECT_LT(walk[i], surface[i] + 0.002);
        }
    }
    // Where the gap is wide, the way around is hardly longer than the straight one.
    EXPECT_GT(dark_wall(Integrator::surface, 60)[0], 0.1);
}

// A sheet of waves with slopes up to 0.2.
TEST(AcrossAGap, the_way_over_small_waves_is_hardly_longer_than_the_straight_one) {
    constexpr float kWaveMm = 5, kSlope = 0.2f, kWaveNumber = 2 * std::numbers::pi_v<float> / kWaveMm;
    const Mesh waves = test::grid(400, 100, [&](float u, float v) {
        const float x = 40 * (u - 0.5f), slope = kSlope * std::cos(kWaveNumber * x);
        return test::Placed{{x, 40 * (0.5f - v), kSlope / kWaveNumber * std::sin(kWaveNumber * x)},
                            normalize(Vec3{-slope, 0, 1})};
    });
    const RayScene rays = std::move(*RayScene::build(waves));
    const auto point_at = [&](float x, float y) {
        const auto hit = rays.closest_hit(RaySet::skin, {.origin_mm = {x, y, 5}, .direction = {0, 0, -1}});
        return SkinPoint{rays.surface_at(*hit).p_world_mm, hit->n_face};
    };
    Pcg32 random(1, 2);
    int longer = 0;
    for (int i = 0; i < 5000; ++i) {
        const float x = 10 * (random.next_1d() - 0.5f), y = 10 * (random.next_1d() - 0.5f);
        const float angle_rad = kWaveNumber * kWaveMm * random.next_1d(),
                    far_mm = 0.01f + 4 * random.next_1d();
        const SkinPoint a = point_at(x, y),
                        b = point_at(x + far_mm * std::cos(angle_rad), y + far_mm * std::sin(angle_rad));
        const float straight_mm = length(b.p_mm - a.p_mm), way_mm = way_through_flesh_mm(rays, a, b, 20);
        ASSERT_GE(way_mm, straight_mm * (1 - 1e-5f));
        ASSERT_LE(way_mm, straight_mm * 1.02f) << x << " " << y << ", " << far_mm << " mm at " << angle_rad;
        longer += way_mm > straight_mm * 1.001f;
    }
    EXPECT_GT(longer, 100);
}

}  // namespace dermis
