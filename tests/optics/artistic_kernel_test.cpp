// The kernel of the separable blur's code against its taps, and its width for a skin against waves of light.

#include "dermis/optics/artistic_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/optics/presets.h"

using namespace dermis;

namespace {

constexpr int kTapsOfSide = 12;
constexpr double kReachMm = 3;

// The published code: at squared steps up to the reach, the kernel's value times the cell between the middles
// of the neighbours, which the spread part's sum divides. From the middle to one side.
std::vector<double> taps_of(const ArtisticKernel& kernel, size_t channel) {
    const auto offset = [](int i) { return kReachMm * i * i / double(kTapsOfSide * kTapsOfSide); };
    std::vector<double> taps;
    double total = 0;
    for (int i = 0; i <= kTapsOfSide; ++i) {
        const double next = offset(std::min(i + 1, kTapsOfSide));
        const double cell = i == 0 ? next : 0.5 * (next - offset(i - 1));
        double value = 0;
        for (size_t t = 1; t < 6; ++t) {
            const GaussianTerm red = gpu_gems_3_skin().terms[t];
            const double x = offset(i) / (0.001 + kernel.falloff[channel]);
            value += red.weight[0] / red.variance_mm2 * std::exp(-x * x / (2 * red.variance_mm2));
        }
        taps.push_back(cell * value);
        total += taps.back() * (i == 0 ? 1 : 2);
    }
    for (double& tap : taps) tap *= kernel.strength[channel] / total;
    taps[0] += 1 - kernel.strength[channel];
    return taps;
}

double tap_mm(size_t i) {
    return kReachMm * double(i * i) / double(kTapsOfSide * kTapsOfSide);
}

}  // namespace

// Its skin_kernel of 25 taps: the first three and the ninth of red, and the first of green and blue.
TEST(ArtisticKernel, has_the_taps_of_godots_shader) {
    const std::vector<double> red = taps_of({}, 0);
    EXPECT_NEAR(red[0], 0.530605, 1e-6);
    EXPECT_NEAR(red[1], 0.0211412, 1e-6);
    EXPECT_NEAR(red[2], 0.0402784, 1e-6);
    EXPECT_NEAR(red[8], 0.0094389, 1e-6);
    EXPECT_NEAR(taps_of({}, 1)[0], 0.613514, 1e-6);
    EXPECT_NEAR(taps_of({}, 2)[0], 0.739601, 1e-6);
}

TEST(ArtisticKernel, has_the_mean_square_of_its_taps) {
    const ArtisticKernel kernel;
    const Rgb cut = mean_square_along_line_mm2(kernel, kReachMm);
    const Rgb whole = mean_square_along_line_mm2(kernel, INFINITY);
    const GaussianSum line = line_kernel(kernel);
    for (size_t c = 0; c < 3; ++c) {
        const std::vector<double> taps = taps_of(kernel, c);
        double of_taps = 0, of_line = 0;
        for (size_t i = 1; i < taps.size(); ++i) of_taps += 2 * taps[i] * tap_mm(i) * tap_mm(i);
        for (const GaussianTerm& term : line.terms) of_line += term.weight[c] * term.variance_mm2;
        EXPECT_NEAR(cut[c] / of_taps, 1, 0.06) << c;
        EXPECT_NEAR(whole[c] / of_line, 1, 1e-12) << c;
    }
    EXPECT_LT(cut[0], 0.75 * whole[0]);  // the widest Gaussian reaches far beyond
}

// A wave of light, long beside the skin's lengths, loses 1 - transfer.
TEST(FittedWidth, blurs_long_waves_most_as_the_skin_and_states_how_well) {
    const GaussianSum line = line_kernel({});
    constexpr double kWaveNumberPerMm = 0.01;
    for (const char* name : {"openpbr_skin_1", "openpbr_skin_3", "gpu_gems_3", "jensen_skin1"}) {
        const Profile skin = *find_profile(name);
        const auto error = [&](double width) {
            double sum = 0;
            for (size_t c = 0; c < 3; ++c) {
                double kernel_lost = 0, skin_lost = 0;
                for (const GaussianTerm& term : line.terms)
                    kernel_lost -= term.weight[c] * std::expm1(-term.variance_mm2 * width * width *
                                                               std::pow(kWaveNumberPerMm, 2) / 2);
                // Of the profile itself, by rings: the mean of 1 - cos over a ring is k^2 r^2 / 4.
                constexpr int kRings = 4000;
                for (int i = 0; i < kRings; ++i)
                    skin_lost +=
                        std::pow(kWaveNumberPerMm * inverse_cdf_mm(skin, int(c), (i + 0.5) / kRings), 2) / 4 /
                        kRings;
                sum += std::pow(diffuse_albedo(skin, int(c)) * (kernel_lost - skin_lost), 2);
            }
            return std::sqrt(sum);
        };
        const KernelWidth fit = fitted_width(mean_square_along_line_mm2({}, INFINITY), skin);
        EXPECT_NEAR(fit.share, 1 - error(fit.width) / error(0), 0.01) << name;
        EXPECT_LT(error(fit.width), error(1.02 * fit.width)) << name;
        EXPECT_LT(error(fit.width), error(0.98 * fit.width)) << name;
    }
}

TEST(FittedWidth, of_a_skin_as_wide_as_the_kernel_in_each_channel_is_its_own) {
    const Rgb kernel_mm2 = mean_square_along_line_mm2({}, kReachMm);
    Profile skin = *find_profile("gpu_gems_3");
    GaussianSum sum;
    for (size_t c = 0; c < 3; ++c) {
        GaussianTerm term = {.variance_mm2 = 2.5 * 2.5 * kernel_mm2[c], .weight = {}};
        term.weight[c] = 0.1 + 0.3 * double(c);
        sum.terms.push_back(term);
    }
    skin.model = sum;
    const KernelWidth fit = fitted_width(kernel_mm2, skin);
    EXPECT_NEAR(fit.width, 2.5, 1e-9);
    EXPECT_NEAR(fit.share, 1, 1e-6);
}
