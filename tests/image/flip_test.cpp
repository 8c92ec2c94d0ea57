// FLIP against the definition in Andersson et al. 2020, written here without separating any filter and in
// double.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/image/colour.h"
#include "dermis/image/metrics.h"
#include "image/test_images.h"

using namespace dermis;

namespace {

struct Double3 {
    double x = 0, y = 0, z = 0;
};

Double3 times(const Mat3& m, Double3 v) {
    const auto row = [&](int r) { return m.row[r].x * v.x + m.row[r].y * v.y + m.row[r].z * v.z; };
    return {row(0), row(1), row(2)};
}

// A picture whose border repeats outwards.
struct Picture {
    int width, height;
    std::vector<Double3> texels;
    [[nodiscard]] const Double3& at(int x, int y) const {
        return texels[size_t(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
    }
};

const Double3 kWhite = times(kXyzFromLinear, {1, 1, 1});

Picture opponent(const Image& image) {
    Picture p{image.width, image.height, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Double3 xyz =
                times(kXyzFromLinear, {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
            const double rx = xyz.x / kWhite.x, ry = xyz.y / kWhite.y, rz = xyz.z / kWhite.z;
            p.texels.push_back({116 * ry - 16, 500 * (rx - ry), 200 * (ry - rz)});
        }
    return p;
}

// One texel under the three contrast sensitivity filters.
Double3 filtered(const Picture& p, int x, int y, double ppd) {
    const double pi = std::numbers::pi;
    const int reach = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    Double3 sum, weight;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const double d2 = (dx * dx + dy * dy) / (ppd * ppd);
            const auto g = [&](double a, double b) {
                return a * std::sqrt(pi / b) * std::exp(-pi * pi * d2 / b);
            };
            const Double3 w = {g(1, 0.0047), g(1, 0.0053), g(34.1, 0.04) + g(13.5, 0.025)};
            const Double3& v = p.at(x + dx, y + dy);
            sum = {sum.x + w.x * v.x, sum.y + w.y * v.y, sum.z + w.z * v.z};
            weight = {weight.x + w.x, weight.y + w.y, weight.z + w.z};
        }
    return {sum.x / weight.x, sum.y / weight.y, sum.z / weight.z};
}

Double3 hunt_lab(Double3 linear) {
    const Double3 xyz = times(kXyzFromLinear, linear);
    const auto f = [](double t) {
        const double d = 6.0 / 29.0;
        return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29.0;
    };
    const double fx = f(xyz.x / kWhite.x), fy = f(xyz.y / kWhite.y), fz = f(xyz.z / kWhite.z);
    const double L = 116 * fy - 16;
    return {L, 0.01 * L * 500 * (fx - fy), 0.01 * L * 200 * (fy - fz)};
}

Double3 perceived(const Picture& p, int x, int y, double ppd) {
    const Double3 o = filtered(p, x, y, ppd);
    const double ry = (o.x + 16) / 116, rx = ry + o.y / 500, rz = ry - o.z / 200;
    const Double3 rgb = times(kLinearFromXyz, {rx * kWhite.x, ry * kWhite.y, rz * kWhite.z});
    return hunt_lab({std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)});
}

double distance(Double3 a, Double3 b) {
    return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), 0.7);
}

double colour_difference(Double3 a, Double3 b) {
    const double largest = distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), knee = 0.4 * largest;
    const double d = distance(a, b);
    return d < knee ? 0.95 / knee * d : 0.95 + (d - knee) / (largest - knee) * 0.05;
}

// Strength of the edge (order 1) or point (order 2) at a texel, with kernels whose positive and negative
// weights sum to 1 and -1.
double feature(const Picture& p, int x, int y, double ppd, int order) {
    const double sigma = 0.5 * 0.082 * ppd;
    const int reach = int(std::ceil(3 * sigma));
    double positive = 0, negative = 0, plus[2] = {}, minus[2] = {};
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const double g = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
            const auto kernel = [&](double t) {
                return order == 1 ? -t * g : (t * t / (sigma * sigma) - 1) * g;
            };
            (kernel(dx) > 0 ? positive : negative) += std::abs(kernel(dx));
            const double v = (p.at(x + dx, y + dy).x + 16) / 116;
            for (int axis = 0; axis < 2; ++axis) {
                const double w = kernel(axis == 0 ? dx : dy);
                (w > 0 ? plus : minus)[axis] += w * v;
            }
        }
    return std::hypot(plus[0] / positive + minus[0] / negative, plus[1] / positive + minus[1] / negative);
}

double flip_at(const Picture& a, const Picture& b, int x, int y, double ppd) {
    const double edges = std::abs(feature(a, x, y, ppd, 1) - feature(b, x, y, ppd, 1));
    const double points = std::abs(feature(a, x, y, ppd, 2) - feature(b, x, y, ppd, 2));
    const double df = std::sqrt(std::max(edges, points) / std::numbers::sqrt2);
    return std::pow(colour_difference(perceived(a, x, y, ppd), perceived(b, x, y, ppd)), 1 - df);
}

Image filled(int width, int height, float value) {
    Image image(width, height, 3);
    for (float& v : image.floats()) v = value;
    return image;
}

}  // namespace

TEST(Flip, agrees_with_its_definition_at_every_texel) {
    const Image a = test_pattern(26, 19, 3);
    Image b = a;
    for (int y = 5; y < 12; ++y)
        for (int x = 8; x < 15; ++x) b.set(x, y, x % 3, 0.9f - 0.05f * float(y));
    for (const double ppd : {15.0, 67.02}) {
        const Image map = *flip_map(a, b, ppd);
        const Picture oa = opponent(a), ob = opponent(b);
        for (int y = 0; y < 19; ++y)
            for (int x = 0; x < 26; ++x) {
                const double expected = flip_at(oa, ob, x, y, ppd);
                // Where the pictures are equal, rounding differs and 0.7th powers of it are not small.
                ASSERT_NEAR(map.at(x, y, 0), expected, 1e-3) << x << ' ' << y << " at " << ppd;
            }
    }
}

TEST(Flip, of_black_and_white_is_the_compressed_lightness_difference) {
    const double largest = distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
    const double expected = 0.95 + 0.05 * (std::pow(100.0, 0.7) / largest - 0.4) / 0.6;
    EXPECT_NEAR(expected, 0.967, 1e-3);
    EXPECT_NEAR(*mean_flip(filled(32, 32, 0), filled(32, 32, 1)), expected, 1e-4);
}

TEST(Flip, blue_and_green_are_furthest_apart) {
    Image green(16, 16, 3), blue(16, 16, 3);
    for (size_t i = 0; i < green.pixel_count(); ++i) green.floats()[3 * i + 1] = blue.floats()[3 * i + 2] = 1;
    EXPECT_NEAR(*mean_flip(green, blue), 1.0, 1e-4);
}

TEST(Flip, is_symmetric_and_grows_with_the_difference) {
    const Image reference = test_pattern(40, 40, 3);
    double before = 0;
    for (const float offset : {0.01f, 0.02f, 0.05f, 0.1f, 0.2f}) {
        Image image = reference;
        for (float& value : image.floats()) value += offset;
        const double there = *mean_flip(image, reference), back = *mean_flip(reference, image);
        EXPECT_NEAR(there, back, 1e-9);
        EXPECT_GT(there, before);
        before = there;
    }
}

TEST(Flip, fine_dither_is_invisible_from_a_distance) {
    const Image flat = filled(64, 64, 0.5f);
    Image dithered = flat;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) dithered.set(x, y, c, (x + y) % 2 ? 0.55f : 0.45f);
    const double near = *mean_flip(dithered, flat, {}, 10), far = *mean_flip(dithered, flat, {}, 80);
    EXPECT_LT(far, 0.25 * near);
    EXPECT_GT(near, 0.05);
}

TEST(Flip, light_beyond_the_display_changes_nothing) {
    EXPECT_EQ(*mean_flip(filled(8, 8, 1.0f), filled(8, 8, 7.0f)), 0);
    EXPECT_EQ(*mean_flip(filled(8, 8, 0.0f), filled(8, 8, -3.0f)), 0);
}
