#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "dermis/image/half.h"
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

struct Table {
    int size;
    std::vector<std::byte> bytes;

    explicit Table(int side) : size(side), bytes(make_brdf_table(side)) {}
    Vec2 at(int x, int y) const {
        uint16_t texel[2];
        std::memcpy(texel, &bytes[size_t(y * size + x) * sizeof texel], sizeof texel);
        return {from_half(texel[0]), from_half(texel[1])};
    }
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

TEST(BrdfTable, no_surface_reflects_more_than_it_receives_and_smooth_ones_reflect_all) {
    const Table table(16);
    for (int y = 0; y < 16; ++y)
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
