#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "dermis/image/half.h"
#include "dermis/optics/microfacet.h"
#include "dermis/scene/brdf_table.h"

using namespace dermis;

namespace {

// The same integral over light directions instead of samples of the lobe: midpoints in cos(theta) and phi.
Vec2 by_quadrature(float roughness, float n_dot_v) {
    const double a2 = std::pow(double(roughness), 4), nv = double(n_dot_v), sv = std::sqrt(1 - nv * nv);
    constexpr int kCosines = 600, kAzimuths = 600;
    double scale = 0, bias = 0;
    for (int i = 0; i < kCosines; ++i)
        for (int j = 0; j < kAzimuths; ++j) {
            const double nl = (i + 0.5) / kCosines, sl = std::sqrt(1 - nl * nl);
            const double phi = std::numbers::pi * (j + 0.5) / kAzimuths;
            const double vl = sv * sl * std::cos(phi) + nv * nl;
            const double half = std::sqrt(2 + 2 * vl), nh = (nl + nv) / half, vh = half / 2;
            const double d = nh * nh * (a2 - 1) + 1;
            const double visibility =
                0.5 / (nv * std::sqrt(nl * nl * (1 - a2) + a2) + nl * std::sqrt(nv * nv * (1 - a2) + a2));
            const double value = a2 / (std::numbers::pi * d * d) * visibility * nl;
            const double fresnel = std::pow(1 - vh, 5);
            scale += value * (1 - fresnel), bias += value * fresnel;
        }
    const double cell = 2 * std::numbers::pi / kAzimuths / kCosines;
    return {float(scale * cell), float(bias * cell)};
}

// Kelemen, Szirmay-Kalos over Beckmann's distribution.
Vec2 ksk_by_quadrature(float roughness, float n_dot_v) {
    const double a2 = std::pow(double(roughness), 4), nv = double(n_dot_v), sv = std::sqrt(1 - nv * nv);
    constexpr int kCosines = 600, kAzimuths = 600;
    double scale = 0, bias = 0;
    for (int i = 0; i < kCosines; ++i)
        for (int j = 0; j < kAzimuths; ++j) {
            const double nl = (i + 0.5) / kCosines, sl = std::sqrt(1 - nl * nl);
            const double phi = std::numbers::pi * (j + 0.5) / kAzimuths;
            const double half = std::sqrt(2 + 2 * (sv * sl * std::cos(phi) + nv * nl)), vh = half / 2;
            const double c2 = std::pow((nl + nv) / half, 2);
            const double d = std::exp((c2 - 1) / (a2 * c2)) / (std::numbers::pi * a2 * c2 * c2);
            const double value = d / (4 * vh * vh) * nl, fresnel = std::pow(1 - vh, 5);
            scale += value * (1 - fresnel), bias += value * fresnel;
        }
    const double cell = 2 * std::numbers::pi / kAzimuths / kCosines;
    return {float(scale * cell), float(bias * cell)};
}

struct Table {
    int size;
    std::vector<std::byte> bytes;

    explicit Table(int side) : size(side), bytes(make_brdf_table(side)) {}
    Vec4 texel(int x, int y) const {
        uint16_t half[4];
        std::memcpy(half, &bytes[size_t(y * size + x) * sizeof half], sizeof half);
        return {from_half(half[0]), from_half(half[1]), from_half(half[2]), from_half(half[3])};
    }
    Vec2 at(int x, int y) const { return {texel(x, y).x, texel(x, y).y}; }
    Vec2 bilinear(float u, float v) const {
        const float x = u * float(size) - 0.5f, y = v * float(size) - 0.5f;
        const int x0 = int(x), y0 = int(y);
        const float fx = x - float(x0), fy = y - float(y0);
        return (at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx) * (1 - fy) +
               (at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx) * fy;
    }
};

}  // namespace

TEST(BrdfTable, sampling_the_lobe_agrees_with_quadrature_over_the_hemisphere) {
    for (const float roughness : {0.3f, 0.5f, 1.0f})
        for (const float n_dot_v : {0.1f, 0.5f, 1.0f}) {
            const Vec2 sampled = ggx_scale_and_bias(roughness, n_dot_v),
                       exact = by_quadrature(roughness, n_dot_v);
            EXPECT_NEAR(sampled.x, exact.x, 0.002) << roughness << " " << n_dot_v;
            EXPECT_NEAR(sampled.y, exact.y, 0.002) << roughness << " " << n_dot_v;
        }
}

TEST(BrdfTable, kelemens_lobe_agrees_with_quadrature_over_the_hemisphere) {
    for (const float roughness : {0.3f, 0.5f, 1.0f})
        for (const float n_dot_v : {0.1f, 0.5f, 1.0f}) {
            const Vec2 sampled = ksk_scale_and_bias(roughness, n_dot_v),
                       exact = ksk_by_quadrature(roughness, n_dot_v);
            EXPECT_NEAR(sampled.x, exact.x, 0.006) << roughness << " " << n_dot_v;
            EXPECT_NEAR(sampled.y, exact.y, 0.004) << roughness << " " << n_dot_v;
        }
}

TEST(BrdfTable, squares_are_of_ggx_and_kelemen_with_the_means_over_the_hemisphere) {
    constexpr int kSide = 32;
    const Table table(kSide);
    for (int lobe = 0; lobe < kBrdfLobes; ++lobe)
        for (const int y : {3, 14, 31}) {
            const float roughness = (float(y) + 0.5f) / kSide;
            const Vec2 expected = lobe == kBrdfLobeKsk ? ksk_scale_and_bias(roughness, 9.5f / kSide)
                                                       : ggx_scale_and_bias(roughness, 9.5f / kSide);
            double scale = 0, bias = 0;
            for (int i = 0; i < 200; ++i) {
                const float cosine = (float(i) + 0.5f) / 200;
                const Vec2 at = lobe == kBrdfLobeKsk ? ksk_scale_and_bias(roughness, cosine)
                                                     : ggx_scale_and_bias(roughness, cosine);
                scale += double(at.x * 2 * cosine / 200), bias += double(at.y * 2 * cosine / 200);
            }
            const Vec4 texel = table.texel(9, lobe * kSide + y);
            EXPECT_NEAR(texel.x, expected.x, 1e-3) << lobe << " " << roughness;
            EXPECT_NEAR(texel.y, expected.y, 1e-3) << lobe << " " << roughness;
            EXPECT_NEAR(texel.z, scale, 2e-3) << lobe << " " << roughness;
            EXPECT_NEAR(texel.w, bias, 2e-3) << lobe << " " << roughness;
        }
}

namespace {

// Light of a lobe within an angle of the mirrored direction, at normal incidence, 0 to 90 degrees.
std::vector<double> light_within(const std::function<double(double)>& distribution) {
    constexpr int kSteps = 1500;
    std::vector<double> sum;
    for (int i = 0; i < kSteps; ++i) {
        const double angle = (i + 0.5) / kSteps * std::numbers::pi / 2;
        const double light = distribution(std::cos(angle / 2)) * std::cos(angle) * std::sin(angle);
        sum.push_back((sum.empty() ? 0 : sum.back()) + light);
    }
    for (double& s : sum) s /= sum.back();
    return sum;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

}  // namespace

// The numbers of constants.h.
TEST(BrdfTable, a_beckmann_lobe_is_a_ggx_lobe_of_the_fitted_roughness) {
    for (const float roughness : {0.15f, 0.2f, 0.3f, 0.45f, 0.6f, 0.8f, 0.95f}) {
        const auto ggx = [](float r) {
            return light_within([r](double c) { return ggx_d(c, double(r) * double(r)); });
        };
        const float factor = std::clamp(kBeckmannAsGgxAt0 + kBeckmannAsGgxSlope * roughness,
                                        kBeckmannAsGgxLeast, kBeckmannAsGgxMost);
        const auto beckmann = light_within(
            [roughness](double c) { return beckmann_d(c, double(roughness) * double(roughness)); });
        const double fitted = largest_difference(ggx(factor * roughness), beckmann);
        EXPECT_LT(fitted, roughness < 0.45f ? 0.105 : 0.08) << roughness;
        double least = 1;
        for (float other = 0.7f; other < 1.2f; other += 0.02f)
            least = std::min(least, largest_difference(ggx(other * roughness), beckmann));
        EXPECT_LT(fitted, least + 0.015) << roughness;
    }
    EXPECT_GT(largest_difference(light_within([](double c) { return ggx_d(c, 0.04); }),
                                 light_within([](double c) { return beckmann_d(c, 0.04); })),
              0.19);
}

// Kelemen, Szirmay-Kalos 2001: with 1 - a(l) at entry, 1 - a(v) at exit and 1 / (1 - A) the matte part
// returns albedo (1 - a(v)) of even light.
TEST(BrdfTable, entry_and_exit_leave_the_diffuse_light_what_is_not_reflected) {
    const Result<BrdfTable> table = BrdfTable::load();
    ASSERT_TRUE(table) << table.error().message;
    for (int lobe = 0; lobe < kBrdfLobes; ++lobe)
        for (const float roughness : {0.1f, 0.45f, 0.9f}) {
            const float f0 = 0.028f;
            double entered = 0;
            for (int i = 0; i < 500; ++i) {
                const float cosine = (float(i) + 0.5f) / 500;
                const Vec4 terms = table->at(lobe, roughness, cosine);
                entered += double((1 - f0 * terms.x - terms.y) * 2 * cosine / 500);
            }
            const Vec4 mean = table->at(lobe, roughness, 0.5f);
            EXPECT_NEAR(entered / double(1 - f0 * mean.z - mean.w), 1, 5e-4) << lobe << " " << roughness;
        }
}

TEST(BrdfTable, no_surface_reflects_more_than_it_receives_and_smooth_ones_reflect_all) {
    const Table table(16);
    for (int y = 0; y < kBrdfLobes * 16; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_LE(table.at(x, y).x + table.at(x, y).y, 1.001f);
    const Vec2 smooth = ggx_scale_and_bias(0.05f, 0.7f);
    EXPECT_NEAR(smooth.x + smooth.y, 1, 0.005);
}

TEST(BrdfTable, rows_are_roughness_and_columns_the_cosine_of_the_view) {
    const Vec2 expected = ggx_scale_and_bias(2.5f / 8, 6.5f / 8), stored = Table(8).at(6, 2);
    EXPECT_NEAR(stored.x, expected.x, 1e-3);
    EXPECT_NEAR(stored.y, expected.y, 1e-4);
}

TEST(BrdfTable, bilinear_lookups_between_texels_stay_close) {
    const Table table(64);
    for (const float roughness : {0.13f, 0.3f, 0.45f, 0.8f})
        for (const float n_dot_v : {0.06f, 0.2f, 0.5f, 0.9f}) {
            const Vec2 exact = ggx_scale_and_bias(roughness, n_dot_v),
                       read = table.bilinear(n_dot_v, roughness);
            EXPECT_NEAR(read.x, exact.x, 0.004) << roughness << " " << n_dot_v;
            EXPECT_NEAR(read.y, exact.y, 0.004) << roughness << " " << n_dot_v;
        }
}
