#include "dermis/reference/surface_integrator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/random.h"
#include "dermis/reference/way_through_flesh.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

// One white object under one directional light of irradiance 1, everything that an integrator needs around
// it.
struct Stage {
    Scene scene;
    std::optional<RayScene> rays;
    std::optional<MaterialSet> materials;
    std::optional<EnvironmentSampler> environment;
    std::optional<Lighting> lighting;

    Stage(Mesh mesh, Vec3 to_light, const LightingSettings& settings = {}) {
        scene.objects.push_back({.name = "white", .mesh = std::move(mesh), .classes = {MaterialClass::skin}});
        scene.lights.push_back({.intensity = 1, .to_light_world = to_light, .is_key = true});
        scene.environment.kind = EnvironmentKind::none;
        rays.emplace(*RayScene::build(scene.objects));
        materials.emplace(*MaterialSet::load(scene));
        environment.emplace(*EnvironmentSampler::load(scene.environment));
        lighting.emplace(scene, *rays, *materials, *environment, settings);
    }
    [[nodiscard]] SurfaceIntegrator integrator(const Profile& profile,
                                               const SurfaceIntegratorSettings& settings = {},
                                               double width_scale = 1) const {
        return {*rays, *lighting, ProfileSampler(profile, width_scale), settings};
    }
    // The point of the surface that a line towards the origin of `from` meets first.
    [[nodiscard]] DiffusePoint point_towards(Vec3 from) const {
        const Vec3 n = normalize(from);
        const auto hit = rays->closest_hit(RaySet::skin, {.origin_mm = n * 1000.0f, .direction = -n});
        return {rays->surface_at(*hit).p_world_mm, n, hit->n_face};
    }
};

Receiver receiver_at(const DiffusePoint& point) {
    return {.p_smooth_mm = point.p_mm, .n_geometry = point.n_geometry, .n = point.n_geometry};
}

Profile sum_of(std::vector<GaussianTerm> terms) {
    return {.name = "test", .source = {}, .model = GaussianSum{"test", std::move(terms)}};
}

// Largest |z| of the estimate at points around the terminator and beyond, over all three channels.
template <class Exact>
double worst_deviation(const Profile& profile, float radius_mm, int estimates, Exact exact) {
    const Stage stage(test::sphere(radius_mm, 6), {0, 0, 1});
    const SurfaceIntegrator integrator = stage.integrator(profile, {.probes_of_run = 21});
    double worst = 0;
    for (const float t : {-0.5f, 0.0f, 0.3f, 1.0f}) {
        const Vec3 from{std::sqrt(1 - t * t) * 0.6f, std::sqrt(1 - t * t) * 0.8f, t};
        const DiffusePoint point = stage.point_towards(from);
        const Estimate m = estimate_exitance(integrator, point, receiver_at(point), estimates, 17);
        const Rgb reference = exact(t);
        const float mean[3] = {m.mean.x, m.mean.y, m.mean.z};
        const float error[3] = {m.standard_error.x, m.standard_error.y, m.standard_error.z};
        for (size_t c = 0; c < 3; ++c) {
            // Facets of 0.017 radii displace the reference by some 1e-5; an exact 0 has no error of its own.
            const double z = (mean[c] - reference[c]) / std::hypot(error[c], 5e-5);
            EXPECT_LT(error[c], 0.02) << "t " << t << " channel " << c;
            EXPECT_LT(std::abs(z), 4.5)
                << "t " << t << " channel " << c << ": " << mean[c] << " against " << reference[c];
            worst = std::max(worst, std::abs(z));
        }
    }
    return worst;
}

class SphereRadius : public testing::TestWithParam<float> {};

TEST_P(SphereRadius, every_gaussian_agrees_with_the_exact_sphere_integral) {
    for (const GaussianTerm& term : gpu_gems_3_skin().terms) {
        const GaussianSum one{"one", {{term.variance_mm2, {1, 1, 1}}}};
        const Profile profile = sum_of(one.terms);
        worst_deviation(profile, GetParam(), 100,
                        [&](double t) { return preintegrated_diffuse(one, t, GetParam()); });
    }
}

TEST_P(SphereRadius, the_gpu_gems_3_skin_agrees_with_the_exact_sphere_integral) {
    worst_deviation(*find_profile("gpu_gems_3"), GetParam(), 200,
                    [&](double t) { return preintegrated_diffuse(gpu_gems_3_skin(), t, GetParam()); });
}

TEST_P(SphereRadius, burley_agrees_with_the_exact_sphere_integral) {
    const BurleyProfile burley{.albedo = {1, 1, 1}, .d_mm = {0.448, 0.104, 0.067}};
    const Profile profile{.name = "burley", .source = {}, .model = burley};
    const RadialProfile radial{.reflectance =
                                   [&](double r_mm) {
                                       return Rgb{reflectance_per_mm2(profile, kRed, r_mm),
                                                  reflectance_per_mm2(profile, kGreen, r_mm),
                                                  reflectance_per_mm2(profile, kBlue, r_mm)};
                                   },
                               .finest_mm = 0.067};
    worst_deviation(profile, GetParam(), 200,
                    [&](double t) { return preintegrated_diffuse(radial, std::span(&t, 1), GetParam())[0]; });
}

// The error that few probes have on average, as a part of what scattering does to the sphere. Without the
// series' products it is 0.014 in red.
TEST(SurfaceIntegrator, the_bias_of_few_probes_is_a_hundredth_of_the_effect) {
    constexpr float kRadiusMm = 2;
    constexpr double kMost[2] = {0.012, 0.012};
    const Stage stage(test::sphere(kRadiusMm, 6), {0, 0, 1});
    const SurfaceIntegrator integrator = stage.integrator(*find_profile("gpu_gems_3"), {.probes_of_run = 2});
    double error[2] = {}, effect_squared[2] = {}, variance[2] = {};
    for (int k = 0; k < 16; ++k) {
        const float t = -1 + (float(k) + 0.5f) / 8, s = std::sqrt(1 - t * t);
        const DiffusePoint point = stage.point_towards({0.6f * s, 0.8f * s, t});
        const Estimate m = estimate_exitance(integrator, point, receiver_at(point), 50'000, 17);
        const Rgb exact = preintegrated_diffuse(gpu_gems_3_skin(), t, kRadiusMm);
        const float means[2] = {m.mean.x, m.mean.y};
        const float errors[2] = {m.standard_error.x, m.standard_error.y};
        for (size_t c = 0; c < 2; ++c) {
            const double effect = exact[c] - std::max(t, 0.0f);
            error[c] += (means[c] - exact[c]) * effect;
            effect_squared[c] += effect * effect;
            variance[c] += errors[c] * errors[c] * effect * effect;
        }
    }
    for (size_t c = 0; c < 2; ++c) {
        EXPECT_LT(std::sqrt(variance[c]) / effect_squared[c], kMost[c] / 2);
        EXPECT_LT(std::abs(error[c]) / effect_squared[c], kMost[c])
            << error[c] / effect_squared[c] << " +- " << std::sqrt(variance[c]) / effect_squared[c];
    }
}

INSTANTIATE_TEST_SUITE_P(Spheres, SphereRadius, testing::Values(2.0f, 4.0f, 8.0f, 16.0f));

TEST(SurfaceIntegrator, constant_light_is_returned_without_noise) {
    const Stage stage(test::plane(200, 0, 20), {0, 0, 1});
    const SurfaceIntegrator integrator = stage.integrator(*find_profile("gpu_gems_3"), {});
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const DiffusePoint point{{1, 2, 0}, {0, 0, 1}, {0, 0, 1}};
        const Vec3 m = integrator.estimate(point, receiver_at(point), {1, 1, 1}, {seed, 0, 0}).exitance();
        EXPECT_NEAR(m.x, 1, 1e-5);
        EXPECT_NEAR(m.z, 1, 1e-5);
    }
}

TEST(SurfaceIntegrator, without_normalisation_a_plane_returns_the_albedo) {
    const Stage stage(test::plane(400, 0, 20), {0, 0, 1});
    const Profile profile = *find_profile("jensen_skin1");
    const SurfaceIntegrator integrator =
        stage.integrator(profile, {.probes_of_run = 21, .normalisation = Normalisation::none});
    const Estimate m = estimate_exitance(integrator, {{0, 0, 0}, {0, 0, 1}, {0, 0, 1}}, {}, 200, 3);
    EXPECT_NEAR(m.mean.x, diffuse_albedo(profile, kRed), 4 * m.standard_error.x + 1e-4);
    EXPECT_NEAR(m.mean.y, diffuse_albedo(profile, kGreen), 4 * m.standard_error.y + 1e-4);
    EXPECT_NEAR(m.mean.z, diffuse_albedo(profile, kBlue), 4 * m.standard_error.z + 1e-4);
    EXPECT_LT(m.standard_error.x, 0.02 * m.mean.x);
}

TEST(SurfaceIntegrator, a_shadow_s_edge_is_blurred_by_the_integral_of_the_profile) {
    // A wall's shadow covers x < 0 of the floor. One Gaussian across a straight edge is the normal
    // distribution of the distance to it.
    Mesh floor = test::plane(200, 0, 4);
    Mesh lid = test::grid(1, 1, [](float u, float v) {
        return test::Placed{{-100 * (1 - u), (0.5f - v) * 400, 50}, {0, 0, 1}};
    });
    lid.materials[0].name = "lid";
    Stage stage(test::joined(floor, lid), {0, 0, 1});
    stage.scene.objects[0].classes = {MaterialClass::skin, MaterialClass::other};
    stage.rays.emplace(*RayScene::build(stage.scene.objects));
    const double sigma_mm = 1.5;
    const SurfaceIntegrator integrator = stage.integrator(sum_of({{sigma_mm * sigma_mm, {1, 1, 1}}}));
    for (const float x_mm : {-2.0f, -0.5f, 0.0f, 1.0f, 3.0f}) {
        const Estimate m = estimate_exitance(integrator, {{x_mm, 0, 0}, {0, 0, 1}, {0, 0, 1}}, {}, 100, 5);
        const double exact = 0.5 * std::erfc(-x_mm / sigma_mm / std::sqrt(2.0));
        EXPECT_NEAR(m.mean.x, exact, 4 * m.standard_error.x + 1e-4) << x_mm;
    }
}

TEST(SurfaceIntegrator, light_is_transmitted_through_a_thin_slab) {
    // Two faces of a sheet of thickness h, light from behind: the back's Gaussian at distance h, over both
    // faces'.
    const float h_mm = 2;
    const Mesh sheet = test::joined(test::plane(200, 0, 4), test::ceiling(200, -h_mm));
    const Stage stage(sheet, {0, 0, -1});
    const double v = 3;
    const SurfaceIntegrator integrator = stage.integrator(sum_of({{v, {1, 1, 1}}}), {.probes_of_run = 21});
    const Estimate m = estimate_exitance(integrator, {{0, 0, 0}, {0, 0, 1}, {0, 0, 1}}, {}, 200, 5);
    const double through = std::exp(-h_mm * h_mm / (2 * v));
    EXPECT_NEAR(m.mean.x, through / (1 + through), 4 * m.standard_error.x + 2e-5);
    EXPECT_LT(m.standard_error.x, 0.01);
}

// The integral by points spread evenly over all triangles, each under its own point of the light.
Estimate by_area(const Stage& stage, const ProfileSampler& profile, const DiffusePoint& x, int points) {
    constexpr size_t kBatches = 64;
    const Mesh& mesh = stage.scene.objects[0].mesh;
    std::vector<double> areas;
    double area = 0;
    const auto corner = [&](size_t triangle, size_t i) {
        return mesh.positions_mm[mesh.indices[3 * triangle + i]];
    };
    const auto normal = [&](size_t t) {
        return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    };
    for (size_t t = 0; t < mesh.triangle_count(); ++t) areas.push_back(area += length(normal(t)));
    std::array<Vec3, kBatches> light, reflectance;
    parallel_for(kBatches, 1, [&](size_t begin, size_t end) {
        for (size_t batch = begin; batch < end; ++batch) {
            Pcg32 random(23, uint32_t(batch));
            for (int i = 0; i < points / int(kBatches); ++i) {
                const double at = (random.next_1d() + 0x1p-24 * random.next_1d()) * area;
                const size_t t =
                    std::min(size_t(std::ranges::upper_bound(areas, at) - areas.begin()), areas.size() - 1);
                const float side = std::sqrt(random.next_1d()), v = side * random.next_1d();
                const RayHit hit{
                    .triangle = uint32_t(t), .u = side - v, .v = v, .n_face = normalize(normal(t))};
                const SurfaceAttributes y = stage.rays->surface_at(hit);
                const LightingChoice numbers =
                    stage.lighting->choose({random.next_2d(), random.next_2d(), random.next_1d()});
                if (length(y.p_world_mm - x.p_mm) > profile.max_mm()) continue;
                const Vec3 weight = profile.reflectance(way_through_flesh_mm(
                    *stage.rays, {x.p_mm, x.n_face}, {y.p_world_mm, hit.n_face}, profile.max_mm()));
                light[batch] +=
                    weight * stage.lighting->irradiance(stage.lighting->skin_receiver(y, hit), numbers);
                reflectance[batch] += weight;
            }
        }
    });
    Estimate result;
    for (float Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        double sum = 0, below = 0, squares = 0;
        for (size_t i = 0; i < kBatches; ++i) sum += light[i].*c, below += reflectance[i].*c;
        for (size_t i = 0; i < kBatches; ++i)
            squares += std::pow(light[i].*c - sum / below * reflectance[i].*c, 2);
        result.mean.*c = float(sum / below);
        result.standard_error.*c = float(std::sqrt(squares) / below);
    }
    return result;
}

// A groove with its own shadow: walls that only tangents' probes find, ways around the bottom, a penumbra.
TEST(SurfaceIntegrator, the_mean_is_that_of_points_spread_evenly_over_the_surface) {
    const Stage stage(test::grooved_block(16, 5, 0.3f), {0.5f, 0.8f, 0.33f}, {.penumbra_mm = 1});
    const Profile profile = sum_of({{0.3, {1, 0, 0}}, {1, {0, 1, 0}}, {3, {0, 0, 1}}});
    const ProfileSampler radii(profile, 1);
    const SurfaceIntegrator integrator = stage.integrator(profile, {.probes_of_run = 21});
    int lit = 0;
    for (const Vec3 above : {Vec3{-2, 1, 0}, {1.7f, 1, 0.5f}, {-1.1f, 1, 0}, {0.5f, 1, 0}, {-0.3f, 1, 0}}) {
        const auto hit = stage.rays->closest_hit(RaySet::skin, {.origin_mm = above, .direction = {0, -1, 0}});
        ASSERT_TRUE(hit);
        const SurfaceAttributes at = stage.rays->surface_at(*hit);
        const DiffusePoint point{at.p_world_mm, at.n_geometry_world, hit->n_face};
        const Estimate m =
            estimate_exitance(integrator, point, stage.lighting->skin_receiver(at, *hit), 1500, 7);
        const Estimate even = by_area(stage, radii, point, 1'000'000);
        for (float Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            const double error = std::hypot(m.standard_error.*c, even.standard_error.*c);
            EXPECT_LT(error, 0.02) << above.x;
            EXPECT_NEAR(m.mean.*c, even.mean.*c, 4 * error + 1e-4) << above.x << " +- " << error;
            lit += m.mean.*c > 0.02f;
        }
    }
    EXPECT_GE(lit, 10) << "hardly any light: nothing is tested";
}

// The picture without scattering has the noise of the same points of the light.
TEST(SurfaceIntegrator, the_noise_of_the_penumbra_cancels_in_the_effect_of_a_narrow_profile) {
    const Stage stage(test::grooved_block(16, 5, 0.3f), {0.5f, 0.8f, 0.33f}, {.penumbra_mm = 1});
    const SurfaceIntegrator integrator =
        stage.integrator(sum_of({{1, {1, 1, 1}}}), {.probes_of_run = 5}, 1e-3);
    double without = 0, effect = 0;
    for (uint32_t seed = 0; seed < 200; ++seed) {
        const float x_mm = -1.5f + 0.004f * float(seed);
        const auto hit =
            stage.rays->closest_hit(RaySet::skin, {.origin_mm = {x_mm, 1, 0}, .direction = {0, -1, 0}});
        const SurfaceAttributes at = stage.rays->surface_at(*hit);
        const Receiver receiver = stage.lighting->skin_receiver(at, *hit);
        const auto lambert = [&](uint32_t by) {
            return mean_irradiance(*stage.lighting, receiver, by, 15).x;
        };
        const DiffusePoint point{at.p_world_mm, at.n_geometry_world, hit->n_face};
        const Vec3 reflectance = integrator.reflectance_around(point, 64, seed + 5000);
        without += std::pow(lambert(seed) - lambert(seed + 1000), 2);
        effect +=
            2 * std::pow(integrator.estimate(point, receiver, reflectance, {seed, 0, 0}).scattered.x, 2);
    }
    EXPECT_GT(without, 0.01) << "no penumbra: nothing is tested";
    EXPECT_LT(effect, 0.02 * without);
}

TEST(SurfaceIntegrator, the_tenfold_scene_with_the_tenfold_profile_looks_the_same) {
    const Profile profile = *find_profile("gpu_gems_3");
    const Stage small(test::sphere(5, 5), {0, 0, 1}), large(test::sphere(50, 5), {0, 0, 1});
    const Vec3 from{0.8f, 0.3f, 0.1f};
    const Vec3 a =
        small.integrator(profile).estimate(small.point_towards(from), {}, {1, 1, 1}, {3, 0, 0}).exitance();
    const Vec3 b = large.integrator(profile, {}, 10)
                       .estimate(large.point_towards(from), {}, {1, 1, 1}, {3, 0, 0})
                       .exitance();
    EXPECT_NEAR(a.x, b.x, 2e-3);
    EXPECT_NEAR(a.z, b.z, 2e-3);
}

TEST(ProfileSampler, radii_follow_the_density_and_the_table_is_the_profile) {
    for (const char* name : {"gpu_gems_3", "jensen_skin1", "burley:0.448,0.104,0.067"}) {
        const Profile profile = *find_profile(name);
        const ProfileSampler sampler(profile, 1);
        // The density's share within r.
        const auto within = [&](double r) {
            constexpr int kRings = 20'000;
            const double step = std::log(1e6) / kRings;
            double sum = 0;
            for (int i = 0; i < kRings; ++i) {
                const double at = r * std::exp((i + 0.5 - kRings) * step);
                sum += sampler.density_per_mm2(float(at)) * 2 * M_PI * at * at * step;
            }
            return sum;
        };
        EXPECT_NEAR(within(sampler.max_mm()), 1, 2e-3) << name;
        for (const double u : {0.05, 0.3, 0.5, 0.9, 0.99}) {
            const float r = sampler.sample_radius_mm(float(u));
            EXPECT_NEAR(within(r), u, 3e-3) << name << " " << u;
            for (int c = 0; c < 3; ++c) {
                const double at = inverse_cdf_mm(profile, c, u), exact = reflectance_per_mm2(profile, c, at);
                const Vec3 table = sampler.reflectance(float(at));
                const double value = c == 0 ? table.x : c == 1 ? table.y : table.z;
                EXPECT_NEAR(value, exact, 2e-4 * exact + 1e-7) << name << " " << u << " " << c;
            }
        }
    }
}

}  // namespace
}  // namespace dermis
