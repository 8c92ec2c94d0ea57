#include "dermis/optics/separable_terms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

using namespace dermis;

namespace {

double gaussian(double variance, double x) {
    return std::exp(-x * x / (2 * variance)) / std::sqrt(2 * std::numbers::pi * variance);
}

struct Errors {
    double mean_square = 0;  ///< root, over the kernel's own
    double misplaced = 0;    ///< the part of the light at a wrong place
};

/// Both kernels as seen, summed over a quadrant with cells that grow from the middle.
Errors errors(const GaussianSum& profile, const SeparableTerms& fit, size_t channel) {
    constexpr int kCells = 300;
    constexpr double kReachMm = 10;
    std::vector<double> x(kCells), width(kCells);
    for (int i = 0; i < kCells; ++i) {
        const double begin = std::pow(double(i) / kCells, 2), end = std::pow((i + 1.0) / kCells, 2);
        x[size_t(i)] = kReachMm * (begin + end) / 2;
        width[size_t(i)] = kReachMm * (end - begin);
    }
    double total = 0;
    for (const GaussianTerm& term : profile.terms) total += term.weight[channel];
    std::vector<std::vector<double>> along(fit.terms.size(), std::vector<double>(kCells));
    std::vector<std::vector<double>> own(profile.terms.size(), std::vector<double>(kCells));
    for (size_t i = 0; i < profile.terms.size(); ++i)
        for (size_t j = 0; j < kCells; ++j) {
            own[i][j] = gaussian(profile.terms[i].variance_mm2 + kSeenMm * kSeenMm, x[j]);
            for (size_t k = 0; k < along.size(); ++k)
                along[k][j] += fit.terms[k].amplitude[i][channel] * own[i][j];
        }
    double square = 0, all = 0, wrong = 0;
    for (size_t a = 0; a < kCells; ++a)
        for (size_t b = 0; b < kCells; ++b) {
            double exact = 0, fitted = 0;
            for (size_t i = 0; i < own.size(); ++i)
                exact += profile.terms[i].weight[channel] / total * own[i][a] * own[i][b];
            for (const std::vector<double>& f : along) fitted += f[a] * f[b];
            const double area = 4 * width[a] * width[b];
            square += area * (fitted - exact) * (fitted - exact);
            all += area * exact * exact;
            wrong += area * std::abs(fitted - exact) / 2;
        }
    return {std::sqrt(square / all), wrong};
}

}  // namespace

// What the page of screen_space_separable states.
TEST(SeparableTerms, two_products_misplace_a_fifth_of_the_light_that_one_does) {
    const GaussianSum skin = gpu_gems_3_skin();
    const Errors one = errors(skin, separable_terms(skin, 1), kRed),
                 two = errors(skin, separable_terms(skin, 2), kRed),
                 all = errors(skin, separable_terms(skin, 6), kRed);
    RecordProperty("misplaced_by_one", std::to_string(one.misplaced));
    RecordProperty("misplaced_by_two", std::to_string(two.misplaced));
    // The profile along a line, twice.
    SeparableTerms line = {.terms = {{}}};
    for (const GaussianTerm& term : skin.terms) line.terms[0].amplitude.push_back(term.weight);
    EXPECT_NEAR(errors(skin, line, kRed).misplaced, 0.20, 0.01);
    EXPECT_NEAR(one.misplaced, 0.24, 0.01);
    EXPECT_NEAR(two.misplaced, 0.037, 0.005);
    EXPECT_LT(all.mean_square, 1e-6);
}

TEST(SeparableTerms, leave_out_what_their_eigenvalues_say_before_the_light_is_made_1) {
    const GaussianSum skin = gpu_gems_3_skin();
    for (const size_t channel : {0u, 1u, 2u}) {
        SeparableTerms two = separable_terms(skin, 2);
        double best = 1;  // over scales: the terms were scaled so that their light is 1
        for (const double scale : {0.97, 0.98, 0.99, 0.995, 1.0}) {
            SeparableTerms scaled = two;
            for (SeparableTerm& term : scaled.terms)
                for (Rgb& amplitude : term.amplitude) amplitude[channel] *= std::sqrt(scale);
            best = std::min(best, errors(skin, scaled, channel).mean_square);
        }
        EXPECT_NEAR(best, two.error[channel], 0.002) << channel;
    }
}

TEST(SeparableTerms, have_all_the_light_of_any_profile) {
    for (const char* name : {"gpu_gems_3", "jensen_skin1", "burley:0.8,0.4,0.2"}) {
        const GaussianSum sum = to_gaussian_sum(*find_profile(name)).sum;
        for (int count = 1; count <= 3; ++count) {
            const SeparableTerms fit = separable_terms(sum, count);
            for (size_t c = 0; c < 3; ++c) {
                double light = 0;
                for (const SeparableTerm& term : fit.terms) {
                    double along = 0;
                    for (const Rgb& amplitude : term.amplitude) along += amplitude[c];
                    light += along * along;
                }
                EXPECT_NEAR(light, 1, 1e-9) << name << count << c;
            }
        }
    }
}

TEST(SeparableTerms, of_one_gaussian_are_that_gaussian) {
    const GaussianSum one = {.name = "one", .terms = {{.variance_mm2 = 2, .weight = {1, 0.5, 0}}}};
    const SeparableTerms fit = separable_terms(one, 2);
    EXPECT_NEAR(std::abs(fit.terms[0].amplitude[0][0]), 1, 1e-12);
    EXPECT_NEAR(std::abs(fit.terms[0].amplitude[0][1]), 1, 1e-12);
    EXPECT_EQ(fit.terms[0].amplitude[0][2], 0);  // no reflectance
    EXPECT_EQ(fit.terms[1].amplitude[0][0], 0);
    EXPECT_NEAR(fit.error[0], 0, 1e-12);
}
