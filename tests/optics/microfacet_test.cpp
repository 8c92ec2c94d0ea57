// Fresnel and microfacets: normalisation, furnaces, reciprocity and limits, by the tests' own quadrature.

#include "dermis/optics/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "dermis/optics/fresnel.h"

using namespace dermis;
using std::numbers::pi;

namespace {

struct Direction {
    double x, y, z;
};

double dot(const Direction& a, const Direction& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Direction direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
Direction half_vector(const Direction& a, const Direction& b) {
    const Direction sum{a.x + b.x, a.y + b.y, a.z + b.z};
    const double length = std::sqrt(dot(sum, sum));
    return {sum.x / length, sum.y / length, sum.z / length};
}

// Midpoint rule over the hemisphere, denser towards the pole (theta ~ s^2).
double over_hemisphere(const std::function<double(const Direction&)>& f) {
    constexpr int kTheta = 500, kPhi = 200;
    double sum = 0;
    for (int i = 0; i < kTheta; ++i)
        for (int j = 0; j < kPhi; ++j) {
            const double s = (i + 0.5) / kTheta, theta = pi / 2 * s * s;
            sum += f(direction(theta, 2 * pi * (j + 0.5) / kPhi)) * std::sin(theta) * pi * s;
        }
    return sum / kTheta * 2 * pi / kPhi;
}

}  // namespace

TEST(Fresnel, meets_its_limits) {
    EXPECT_NEAR(fresnel_dielectric(1, 1.4), f0_of_eta(1.4), 1e-15);
    EXPECT_NEAR(f0_of_eta(1.3), 0.0170, 5e-5);
    EXPECT_NEAR(f0_of_eta(1.4), 0.0278, 5e-5);
    EXPECT_EQ(fresnel_dielectric(0, 1.4), 1);
    EXPECT_EQ(fresnel_dielectric(0.5, 1), 0);
    EXPECT_EQ(fresnel_dielectric(0.5, 1 / 1.4), 1) << "beyond the critical angle";
    // Brewster's angle leaves the perpendicular half: ((eta^2 - 1) / (eta^2 + 1))^2 / 2.
    const double eta2 = 1.4 * 1.4;
    EXPECT_NEAR(fresnel_dielectric(1 / std::sqrt(1 + eta2), 1.4), 0.5 * std::pow((eta2 - 1) / (eta2 + 1), 2),
                1e-12);
}

TEST(Fresnel, is_the_same_from_both_sides) {
    for (const double cos_outside : {0.1, 0.4, 0.9}) {
        const double cos_inside = std::sqrt(1 - (1 - cos_outside * cos_outside) / (1.4 * 1.4));
        EXPECT_NEAR(fresnel_dielectric(cos_outside, 1.4), fresnel_dielectric(cos_inside, 1 / 1.4), 1e-12);
    }
}

TEST(Fresnel, schlick_stays_within_its_stated_error_for_skin) {
    double largest = 0, largest_below_75 = 0;
    for (double angle = 0; angle <= 90; angle += 0.25) {
        const double cosine = std::cos(angle * pi / 180);
        const double error =
            std::abs(fresnel_schlick(cosine, f0_of_eta(1.4)) - fresnel_dielectric(cosine, 1.4));
        largest = std::max(largest, error);
        if (angle <= 75) largest_below_75 = std::max(largest_below_75, error);
    }
    EXPECT_LT(largest, 0.047);
    EXPECT_LT(largest_below_75, 0.015);
    EXPECT_GT(largest, 0.04) << "the documented error is no longer true";
}

TEST(Fresnel, diffuse_reflectance_is_its_integral) {
    for (const double eta : {1.2, 1.3, 1.4, 1.5, 1.6}) {
        double inside = 0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i)
            inside += fresnel_dielectric(std::sqrt((i + 0.5) / kSteps), 1 / eta) / kSteps;
        EXPECT_NEAR(diffuse_internal_reflectance(eta), inside, 0.005) << eta;
        // Light in equilibrium crosses both ways alike: 1 - F_outside = eta^2 (1 - F_inside).
        EXPECT_NEAR(1 - diffuse_external_reflectance(eta), eta * eta * (1 - inside), 1e-4) << eta;
    }
}

TEST(Microfacet, distributions_are_normalised) {
    for (const double alpha : {0.1, 0.3, 0.7, 1.0}) {
        const auto projected = [](auto d) {
            return over_hemisphere([&](const Direction& h) { return d(h.z) * h.z; });
        };
        EXPECT_NEAR(projected([&](double c) { return ggx_d(c, alpha); }), 1, 1e-4) << alpha;
        EXPECT_NEAR(projected([&](double c) { return beckmann_d(c, alpha); }), 1, 1e-4) << alpha;
        const double exponent = blinn_phong_exponent(alpha);
        EXPECT_NEAR(projected([&](double c) { return blinn_phong_d(c, exponent); }), 1, 1e-4) << alpha;
    }
}

TEST(Microfacet, visible_facets_have_the_projected_area_of_the_surface) {
    // Heitz 2014, equation 16: the integral of G1(v) max(0, v.h) D(h) is n.v.
    for (const double alpha : {0.2, 0.6})
        for (const double theta : {0.0, 0.6, 1.2, 1.45}) {
            const Direction v = direction(theta, 0);
            const auto covered = [&](auto d, double g1) {
                return g1 * over_hemisphere(
                                [&](const Direction& h) { return std::max(0.0, dot(v, h)) * d(h.z, alpha); });
            };
            EXPECT_NEAR(covered(ggx_d, ggx_smith_g1(v.z, alpha)), v.z, 2e-3) << alpha << " " << theta;
            EXPECT_NEAR(covered(beckmann_d, beckmann_smith_g1(v.z, alpha)), v.z, 2e-3)
                << alpha << " " << theta;
        }
}

TEST(Microfacet, no_surface_reflects_more_than_it_receives) {
    for (const double alpha : {0.3, 0.8})
        for (const double theta : {0.1, 0.9, 1.3}) {
            const Direction v = direction(theta, 0);
            const double reflected = over_hemisphere([&](const Direction& l) {
                const Direction h = half_vector(l, v);
                return l.z * microfacet_brdf(ggx_d(h.z, alpha), ggx_smith_g(l.z, v.z, alpha), 1, l.z, v.z);
            });
            EXPECT_LT(reflected, 1.001) << alpha << " " << theta;
            EXPECT_GT(reflected, 0.4) << alpha << " " << theta;
        }
}

TEST(Microfacet, kelemen_is_cook_torrance_without_shadowing_at_normal_incidence) {
    const double d = beckmann_d(1, 0.3);
    EXPECT_NEAR(kelemen_szirmay_kalos_brdf(d, 0.028, 1), microfacet_brdf(d, 1, 0.028, 1, 1), 1e-12);
    EXPECT_EQ(kelemen_szirmay_kalos_brdf(d, 0.028, 0), 0);
}

TEST(Microfacet, is_reciprocal_and_zero_below_the_horizon) {
    EXPECT_DOUBLE_EQ(ggx_smith_g(0.3, 0.8, 0.5), ggx_smith_g(0.8, 0.3, 0.5));
    EXPECT_DOUBLE_EQ(beckmann_smith_g(0.3, 0.8, 0.5), beckmann_smith_g(0.8, 0.3, 0.5));
    EXPECT_EQ(beckmann_smith_g1(1, 0.5), 1);
    EXPECT_DOUBLE_EQ(oren_nayar(0.3, 0.8, 0.5, 0.4), oren_nayar(0.8, 0.3, 0.5, 0.4));
    EXPECT_EQ(ggx_d(-0.1, 0.5), 0);
    EXPECT_EQ(ggx_smith_g(-0.1, 0.5, 0.5), 0);
    EXPECT_EQ(microfacet_brdf(1, 1, 1, 0.5, 0), 0);
    EXPECT_EQ(oren_nayar(0.5, -0.1, 0.2, 0.4), 0);
}

TEST(OrenNayar, is_lambert_when_smooth_and_stays_within_its_stated_energy) {
    EXPECT_EQ(oren_nayar(0.4, 0.7, 0.6, 0), 1);
    for (const double sigma : {0.3, 0.6})
        for (const double theta : {0.0, 0.8, 1.4, 1.55}) {
            const Direction v = direction(theta, 0);
            const double reflected = over_hemisphere(
                [&](const Direction& l) { return l.z * oren_nayar(l.z, v.z, dot(l, v), sigma) / pi; });
            EXPECT_LT(reflected, 1.0045) << sigma << " " << theta;
            EXPECT_GT(reflected, 0.735) << sigma << " " << theta;
        }
}
