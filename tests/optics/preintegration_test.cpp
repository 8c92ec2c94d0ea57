// The pre-integrated functions against the published vectors, against an independent integrator, and against
// physical laws.

#include "dermis/optics/preintegration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "optics/adaptive_quadrature.h"

using namespace dermis;

namespace {

using std::numbers::pi;
constexpr Construction kConstructions[] = {Construction::sphere, Construction::full_ring,
                                           Construction::half_ring};
constexpr Preintegration kRing = {.construction = Construction::full_ring};
constexpr Preintegration kHalfRing = {.construction = Construction::half_ring};
constexpr Preintegration kRingByArea = {.construction = Construction::full_ring,
                                        .ring_weights = RingWeights::area};

// R(distance) of one channel, Gaussians normalised as areas or as lines.
test::Channel channel_of(const GaussianSum& profile, size_t channel, RingWeights weights) {
    return [=](double d) {
        double sum = 0;
        for (const GaussianTerm& term : profile.terms) {
            const double v = term.variance_mm2;
            const double norm = weights == RingWeights::area ? 2 * pi * v : std::sqrt(2 * pi * v);
            sum += term.weight[channel] * std::exp(-d * d / (2 * v)) / norm;
        }
        return sum;
    };
}

double exact(const GaussianSum& profile, size_t channel, double t, double radius_mm,
             const Preintegration& how) {
    constexpr double kFinest_mm = 0.03;
    if (how.construction == Construction::sphere)
        return test::sphere_integral(channel_of(profile, channel, RingWeights::area), kFinest_mm, t,
                                     radius_mm);
    return test::ring_integral(channel_of(profile, channel, how.ring_weights), kFinest_mm, t, radius_mm,
                               how.construction == Construction::full_ring ? pi : pi / 2);
}

// Largest difference of the red channel between a construction and the sphere, over N.L.
double worst_red_difference(double radius_mm, const Preintegration& how) {
    double worst = 0;
    for (int i = 0; i <= 400; ++i) {
        const double t = -1 + i / 200.0;
        worst = std::max(worst, std::abs(preintegrated_diffuse(gpu_gems_3_skin(), t, radius_mm, how)[0] -
                                         preintegrated_diffuse(gpu_gems_3_skin(), t, radius_mm)[0]));
    }
    return worst;
}

}  // namespace

// Values computed once by two independent double-precision integrators (not by this code), six decimals.
TEST(Preintegration, matches_the_tabulated_vectors) {
    struct Vector {
        double radius_mm, t;
        Rgb sphere, ring, ring_by_area;
    };
    const Vector vectors[] = {
        {1, -0.5, {.084941, .007533, .001100}, {.135378, .007995, .001248}, {.026655, .002125, .000258}},
        {1, 0, {.149197, .077305, .051836}, {.206387, .080905, .052766}, {.077824, .051641, .041108}},
        {1, 1, {.699991, .939116, .976109}, {.695782, .965622, .987149}, {.933728, .986096, .993025}},
        {4, -0.5, {.012628, .000055, .000001}, {.013127, .000052, .000001}, {.001583, .000005, .000000}},
        {4, 0, {.082087, .020550, .013236}, {.087717, .020620, .013249}, {.024416, .012976, .010296}},
        {4, 1, {.918709, .995742, .998452}, {.952976, .997851, .999224}, {.992646, .999156, .999571}},
        {16, 0, {.022197, .005156, .003313}, {.022278, .005158, .003313}, {.006122, .003245, .002574}},
        {16, 1, {.994598, .999734, .999903}, {.997284, .999867, .999952}, {.999569, .999947, .999973}},
    };
    const GaussianSum skin = gpu_gems_3_skin();
    for (const Vector& v : vectors) {
        const Rgb sphere = preintegrated_diffuse(skin, v.t, v.radius_mm);
        const Rgb ring = preintegrated_diffuse(skin, v.t, v.radius_mm, kRing);
        const Rgb by_area = preintegrated_diffuse(skin, v.t, v.radius_mm, kRingByArea);
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(sphere[c], v.sphere[c], 6e-7) << v.radius_mm << " " << v.t << " " << c;
            EXPECT_NEAR(ring[c], v.ring[c], 6e-7) << v.radius_mm << " " << v.t << " " << c;
            EXPECT_NEAR(by_area[c], v.ring_by_area[c], 6e-7) << v.radius_mm << " " << v.t << " " << c;
        }
    }
}

TEST(Preintegration, first_zonal_harmonic_matches_the_tabulated_vectors) {
    const std::pair<double, Rgb> vectors[] = {{1, {.653739, .960031, .998512}},
                                              {4, {.937411, 1.018969, 1.021742}},
                                              {16, {1.017799, 1.023054, 1.023228}}};
    for (const auto& [radius_mm, expected] : vectors)
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(preintegrated_zonal_harmonics(gpu_gems_3_skin(), radius_mm)[1][c], expected[c], 6e-7);
}

TEST(Preintegration, matches_adaptive_quadrature_of_the_definition) {
    const GaussianSum skin = gpu_gems_3_skin();
    for (double radius_mm : {0.25, 0.6, 2.0, 5.0, 16.0, 120.0, 1000.0})
        for (double t : {-1.0, -0.6, -0.21, -0.03, 0.0, 0.004, 0.4, 0.93})
            for (Construction construction : kConstructions) {
                const Preintegration how = {.construction = construction};
                const Rgb value = preintegrated_diffuse(skin, t, radius_mm, how);
                for (size_t c : {0u, 2u})
                    EXPECT_NEAR(value[c], exact(skin, c, t, radius_mm, how), 1e-8)
                        << "radius " << radius_mm << " t " << t << " channel " << c << " construction "
                        << int(construction);
            }
}

// int z exp(kappa z) over [0, 1], and the mean over the terminator's great circle, are elementary.
TEST(Preintegration, matches_its_closed_forms_at_the_pole_and_at_the_terminator) {
    for (double kappa : {0.3, 4.0, 50.0, 63.9, 64.1, 500.0}) {
        const double pole = (kappa - 1 + std::exp(-kappa)) / (kappa * -std::expm1(-2 * kappa));
        EXPECT_NEAR(blurred_cosine(Construction::sphere, 1, kappa), pole, 1e-10) << kappa;
        const double terminator = std::cyl_bessel_i(1, kappa) / (2 * std::sinh(kappa));
        EXPECT_NEAR(blurred_cosine(Construction::sphere, 0, kappa), terminator, 1e-10) << kappa;
    }
}

TEST(Preintegration, is_continuous_across_the_switch_of_method) {
    for (Construction construction : kConstructions)
        for (int i = 0; i <= 500; ++i) {
            const double t = -1 + i / 250.0;
            EXPECT_NEAR(blurred_cosine(construction, t, 64 * (1 - 1e-12)),
                        blurred_cosine(construction, t, 64 * (1 + 1e-12)), 1e-10)
                << t << " " << int(construction);
        }
}

TEST(Preintegration, rows_equal_points) {
    const std::vector<double> t = {0.3, -1, -0.3, 0, 1, 0.77, -0.001, 0.30000001, 0.001};
    for (Construction construction : kConstructions) {
        const Preintegration how = {.construction = construction};
        const DiffuseRows rows(t, how);
        ASSERT_EQ(rows.size(), t.size());
        std::vector<double> row(3 * t.size());
        for (double radius_mm : {0.5, 3.0, 40.0}) {
            rows.evaluate(gpu_gems_3_skin(), radius_mm, row);
            for (size_t i = 0; i < t.size(); ++i) {
                const Rgb point = preintegrated_diffuse(gpu_gems_3_skin(), t[i], radius_mm, how);
                for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(row[3 * i + c], point[c], 1e-13);
            }
        }
    }
}

TEST(Preintegration, a_sphere_conserves_energy) {
    for (double radius_mm : {0.01, 0.25, 1.0, 2.0, 3.7, 8.0, 60.0, 1000.0, 1e9})
        for (double scale : {0.3, 1.0, 1.414}) {
            const Rgb zh_0 =
                preintegrated_zonal_harmonics(gpu_gems_3_skin(), radius_mm, {.variance_scale = scale})[0];
            for (double value : zh_0) EXPECT_NEAR(value, std::sqrt(pi) / 2, 1e-9) << radius_mm;
        }
}

TEST(Preintegration, a_ring_does_not_conserve_energy_where_it_is_strongly_curved) {
    EXPECT_NEAR(preintegrated_zonal_harmonics(gpu_gems_3_skin(), 2, kRing)[0][0], 0.978, 0.0005);
}

TEST(Preintegration, zonal_harmonics_of_a_sphere_have_their_closed_form) {
    // One Gaussian: rho_1 = coth k - 1/k, rho_2 = 1 - 3 rho_1 / k.
    for (double kappa : {0.5, 5.0, 63.0, 65.0, 4000.0}) {
        const double rho_1 = 1 / std::tanh(kappa) - 1 / kappa, rho_2 = 1 - 3 * rho_1 / kappa;
        const auto zonal = preintegrated_zonal_harmonics({"", {{1, {1, 1, 1}}}}, std::sqrt(kappa));
        EXPECT_NEAR(zonal[1][0], std::sqrt(pi / 3) * rho_1, 1e-12);
        EXPECT_NEAR(zonal[2][0], std::sqrt(5 * pi) / 8 * rho_2, 1e-10) << kappa;
    }
}

TEST(Preintegration, zonal_harmonics_of_every_construction_equal_their_integral) {
    for (Construction construction : kConstructions) {
        const Preintegration how = {.construction = construction};
        const auto zonal = preintegrated_zonal_harmonics(gpu_gems_3_skin(), 3, how);
        for (size_t l = 0; l < 3; ++l) {
            const auto integrand = [&](double t) {
                const double legendre = l == 0 ? 1 : l == 1 ? t : 1.5 * t * t - 0.5;
                return preintegrated_diffuse(gpu_gems_3_skin(), t, 3, how)[0] * legendre;
            };
            const double integral =
                test::integrate(integrand, -1, 0, 1e-9) + test::integrate(integrand, 0, 1, 1e-9);
            EXPECT_NEAR(zonal[l][0], 2 * pi * std::sqrt((2 * double(l) + 1) / (4 * pi)) * integral, 1e-7)
                << int(construction) << " " << l;
        }
    }
}

// Theory: the largest differences of published constructions from the sphere, red, three decimals.
TEST(Preintegration, published_constructions_are_wrong_by_what_was_measured) {
    struct Expected {
        Preintegration how;
        double at[4];
    };
    const Expected table[] = {
        {kHalfRing, {.104, .039, .011, .003}},
        {kRing, {.053, .034, .011, .003}},
        {{.construction = Construction::half_ring, .variance_scale = 1.414}, {.087, .026, .009, .004}},
        {{.construction = Construction::half_ring, .ring_weights = RingWeights::area},
         {.191, .074, .032, .016}},
    };
    const double radii_mm[] = {2, 4, 8, 16};
    for (const Expected& row : table)
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(worst_red_difference(radii_mm[i], row.how), row.at[i], 0.00051)
                << int(row.how.construction) << " variance x " << row.how.variance_scale << " r "
                << radii_mm[i];
}

TEST(Preintegration, the_odd_part_is_the_mean_cosine) {
    for (Construction construction : kConstructions)
        for (double radius_mm : {0.3, 2.0, 30.0}) {
            const Preintegration how = {.construction = construction};
            const Rgb mean = preintegrated_mean_cosine(gpu_gems_3_skin(), radius_mm, how);
            for (double t : {0.01, 0.5, 1.0}) {
                const Rgb lit = preintegrated_diffuse(gpu_gems_3_skin(), t, radius_mm, how);
                const Rgb dark = preintegrated_diffuse(gpu_gems_3_skin(), -t, radius_mm, how);
                for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(lit[c] - dark[c], mean[c] * t, 1e-13);
            }
        }
}

TEST(Preintegration, a_flat_or_barely_scattering_surface_is_lambertian) {
    for (Construction construction : kConstructions)
        for (double t : {-1.0, -0.2, 0.0, 0.4, 1.0}) {
            const Preintegration how = {.construction = construction};
            const double infinity = std::numeric_limits<double>::infinity();
            EXPECT_NEAR(preintegrated_diffuse(gpu_gems_3_skin(), t, infinity, how)[0], std::max(0.0, t),
                        1e-15);
            EXPECT_NEAR(blurred_cosine(construction, t, 1e12), std::max(0.0, t), 1e-6);
        }
}

TEST(Preintegration, a_lobe_that_spreads_everywhere_leaves_the_mean_light) {
    for (double t : {-1.0, -0.3, 0.0, 0.8}) {
        EXPECT_NEAR(blurred_cosine(Construction::sphere, t, 0), 0.25, 1e-15);
        EXPECT_NEAR(blurred_cosine(Construction::full_ring, t, 0), 1 / pi, 1e-15);
        EXPECT_NEAR(blurred_cosine(Construction::half_ring, t, 0), (1 + t) / pi, 1e-15);
    }
}

TEST(Preintegration, scaling_the_world_changes_nothing) {
    GaussianSum ten_times = gpu_gems_3_skin();
    for (GaussianTerm& term : ten_times.terms) term.variance_mm2 *= 100;
    for (double radius_mm : {0.5, 2.0, 20.0})
        for (double t : {-0.4, 0.0, 0.1, 0.9})
            EXPECT_NEAR(preintegrated_diffuse(gpu_gems_3_skin(), t, radius_mm)[0],
                        preintegrated_diffuse(ten_times, t, 10 * radius_mm)[0], 1e-14);
}

TEST(Preintegration, weights_sum_to_one_in_each_channel) {
    for (Construction construction : kConstructions)
        for (double radius_mm : {0.01, 1.0, 100.0}) {
            Rgb sum = {};
            for (const Rgb& weight :
                 lobe_weights(gpu_gems_3_skin(), radius_mm, {.construction = construction}))
                for (size_t c = 0; c < 3; ++c) sum[c] += weight[c];
            for (double value : sum) EXPECT_NEAR(value, 1, 1e-14);
        }
}

TEST(Preintegration, bad_profiles_are_refused_with_the_value_and_its_place) {
    const auto message = [](std::vector<GaussianTerm> terms) {
        const Result<void> checked = check_preintegrable({"mine", std::move(terms)});
        return checked ? std::string() : checked.error().message;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(message({}), "profile 'mine' has no Gaussians; it needs at least 1");
    EXPECT_EQ(message({{1, {1, 1, 1}}, {-2, {1, 1, 1}}}),
              "profile 'mine', Gaussian 2: variance_mm2 is -2, must be positive and finite");
    EXPECT_NE(message({{nan, {1, 1, 1}}}).find("variance_mm2 is nan"), std::string::npos);
    EXPECT_NE(message({{1, {1, nan, 1}}}).find("weight is nan"), std::string::npos);
    EXPECT_EQ(message({{1, {1, 0, 1}}}),
              "profile 'mine': the weights of channel g sum to 0, must be above 0");
    EXPECT_TRUE(check_preintegrable(gpu_gems_3_skin()));
}
