// General profiles on the sphere: compared with sums of Gaussians, the tests' integrator and the Legendre
// sum.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/optics/preintegration.h"
#include "optics/adaptive_quadrature.h"

using namespace dermis;

namespace {

using std::numbers::pi;

RadialProfile skin_by_distance() {
    const auto reflectance = [](double d) {
        Rgb sum = {};
        for (const GaussianTerm& term : gpu_gems_3_skin().terms)
            for (size_t c = 0; c < 3; ++c)
                sum[c] += term.weight[c] * std::exp(-d * d / (2 * term.variance_mm2)) / term.variance_mm2;
        return sum;
    };
    return {.reflectance = reflectance, .finest_mm = 0.08};
}

// Christensen, Burley 2015, equation 2, without its constant.
double burley(double d_mm, double distance_mm) {
    return (std::exp(-distance_mm / d_mm) + std::exp(-distance_mm / (3 * d_mm))) / (d_mm * distance_mm);
}

constexpr Rgb kBurley_mm = {1.046, 0.389, 0.055};

RadialProfile burley_skin() {
    const auto reflectance = [](double distance_mm) {
        return Rgb{burley(kBurley_mm[0], distance_mm), burley(kBurley_mm[1], distance_mm),
                   burley(kBurley_mm[2], distance_mm)};
    };
    return {.reflectance = reflectance, .finest_mm = 0.055};
}

}  // namespace

TEST(RadialPreintegration, equals_the_gaussian_sum_it_is_given_as_a_function) {
    const std::vector<double> t = {-1, -0.7, -0.1, 0, 0.02, 0.5, 1};
    for (double radius_mm : {0.25, 1.0, 4.0, 16.0, 1000.0}) {
        const std::vector<Rgb> values = preintegrated_diffuse(skin_by_distance(), t, radius_mm);
        for (size_t i = 0; i < t.size(); ++i) {
            const Rgb expected = preintegrated_diffuse(gpu_gems_3_skin(), t[i], radius_mm);
            for (size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(values[i][c], expected[c], 1e-7) << radius_mm << " " << t[i];
        }
    }
}

TEST(RadialPreintegration, matches_adaptive_quadrature_for_a_profile_with_a_pole) {
    const std::vector<double> t = {-0.8, -0.1, 0, 0.3, 1};
    for (double radius_mm : {0.25, 2.0, 30.0, 1000.0}) {
        const std::vector<Rgb> values = preintegrated_diffuse(burley_skin(), t, radius_mm);
        for (size_t i = 0; i < t.size(); ++i)
            for (size_t c : {0u, 2u}) {
                // The pole at 0 has no weight: sin x vanishes with it.
                const auto channel = [&](double d) { return burley(kBurley_mm[c], std::max(d, 1e-12)); };
                const double expected = test::sphere_integral(channel, kBurley_mm[c] / 16, t[i], radius_mm);
                EXPECT_NEAR(values[i][c], expected, 1e-7) << radius_mm << " " << t[i] << " " << c;
            }
    }
}

// D(t) = sum a_l rho_l P_l(t) with rho_l by quadrature over s = d^2 / 4r^2: another route to the same
// function.
TEST(RadialPreintegration, matches_its_legendre_sum) {
    const double radius_mm = 2;
    const auto moment = [&](size_t l) {
        const auto integrand = [&](double root) {  // d = 2 r root^2 takes the pole away
            const double d = 2 * radius_mm * root * root, s = root * root * root * root;
            return burley(kBurley_mm[0], std::max(d, 1e-12)) * std::legendre(unsigned(l), 1 - 2 * s) * 4 *
                   root * root * root;
        };
        return test::integrate(integrand, 0, 1, 1e-11);
    };
    const double mass = moment(0);
    for (double t : {-0.9, -0.3, 0.6}) {
        double sum = 0.5 * moment(1) / mass * t, a = 0.5;
        for (size_t l = 0; l < 80; l += 2) {
            const double legendre = std::legendre(unsigned(l), std::abs(t));  // l is even
            sum += (2 * double(l) + 1) / 2 * a * moment(l) / mass * legendre;
            a *= (1 - double(l)) / (double(l) + 4);
        }
        EXPECT_NEAR(preintegrated_diffuse(burley_skin(), std::vector{t}, radius_mm)[0][0], sum, 5e-6)
            << t;  // the sum ends at 80
    }
}

TEST(RadialPreintegration, zonal_harmonics_equal_those_of_the_gaussian_sum) {
    for (double radius_mm : {0.3, 2.0, 50.0}) {
        const auto zonal = preintegrated_zonal_harmonics(skin_by_distance(), radius_mm);
        const auto expected = preintegrated_zonal_harmonics(gpu_gems_3_skin(), radius_mm);
        for (size_t l = 0; l < 3; ++l)
            for (size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(zonal[l][c], expected[l][c], 1e-8) << radius_mm << l << c;
    }
}

TEST(RadialPreintegration, a_flat_surface_is_lambertian) {
    const std::vector<Rgb> values = preintegrated_diffuse(burley_skin(), std::vector{-0.5, 0.5}, INFINITY);
    EXPECT_EQ(values[0][0], 0);
    EXPECT_EQ(values[1][2], 0.5);
    EXPECT_NEAR(preintegrated_zonal_harmonics(burley_skin(), INFINITY)[2][0], std::sqrt(5 * pi) / 8, 1e-15);
}
