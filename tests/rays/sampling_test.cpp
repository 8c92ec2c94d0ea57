// Every sampler against its density: chi-squared over boxes of the domain, and moments that are known.

#include "dermis/rays/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <vector>

#include "dermis/rays/random.h"

namespace dermis {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kSamples = 200'000;

// Pearson's statistic against expected counts, as a number of standard deviations (Wilson and Hilferty 1931).
// Boxes that expect fewer than five are merged into the next.
double chi_squared_deviation(const std::vector<double>& observed, const std::vector<double>& expected) {
    double statistic = 0, o = 0, e = 0;
    int boxes = 0;
    for (size_t i = 0; i < observed.size(); ++i) {
        o += observed[i];
        e += expected[i];
        if (e < 5) continue;
        statistic += (o - e) * (o - e) / e;
        ++boxes;
        o = e = 0;
    }
    const double k = boxes - 1, spread = 2 / (9 * k);
    return (std::cbrt(statistic / k) - (1 - spread)) / std::sqrt(spread);
}

// Directions in boxes of cosine and azimuth against the integral of a density, by the midpoint rule in each
// box.
double direction_deviation(const std::function<Vec3(Pcg32&)>& sample,
                           const std::function<double(Vec3)>& density) {
    constexpr int kRows = 20, kColumns = 24, kSteps = 24;
    // Narrow lobes vary fast in z: within a box, z has kSteps^2 points and the azimuth goes along.
    std::vector<double> observed(kRows * kColumns), expected(kRows * kColumns);
    Pcg32 random(7, 1);
    for (int i = 0; i < kSamples; ++i) {
        const Vec3 d = sample(random);
        EXPECT_NEAR(length(d), 1, 1e-4);
        const int row = std::clamp(int((d.z + 1) / 2 * kRows), 0, kRows - 1);
        const int column =
            std::clamp(int((std::atan2(d.y, d.x) / (2 * kPi) + 0.5f) * kColumns), 0, kColumns - 1);
        ++observed[size_t(row * kColumns + column)];
    }
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            for (int i = 0; i < kSteps * kSteps; ++i) {
                const double z = -1 + 2 * (row + (i + 0.5) / (kSteps * kSteps)) / kRows;
                const double a =
                    2 * std::numbers::pi * (((column + (i % kSteps + 0.5) / kSteps) / kColumns) - 0.5);
                const double s = std::sqrt(1 - z * z);
                const Vec3 d{float(s * std::cos(a)), float(s * std::sin(a)), float(z)};
                expected[size_t(row * kColumns + column)] +=
                    kSamples * density(d) * 4 * std::numbers::pi / kRows / kColumns / kSteps / kSteps;
            }
    return chi_squared_deviation(observed, expected);
}

TEST(Sampling, the_chi_squared_test_refuses_a_wrong_density) {
    const auto uniform = [](Pcg32& r) { return sample_sphere(r.next_2d()); };
    EXPECT_GT(direction_deviation(uniform, [](Vec3 d) { return (1 + 0.1 * d.z) / (4 * kPi); }), 6);
    EXPECT_GT(direction_deviation(uniform, [](Vec3 d) { return (1 + 0.1 * d.x) / (4 * kPi); }), 6);
}

TEST(Sampling, sphere_and_cosine_hemisphere_follow_their_densities) {
    EXPECT_LT(direction_deviation([](Pcg32& r) { return sample_sphere(r.next_2d()); },
                                  [](Vec3) { return 1 / (4 * kPi); }),
              4);
    EXPECT_LT(direction_deviation([](Pcg32& r) { return sample_cosine_hemisphere(r.next_2d()); },
                                  [](Vec3 d) { return std::max(0.0f, d.z) / kPi; }),
              4);
}

TEST(Sampling, henyey_greenstein_follows_its_density_and_mean_cosine) {
    for (const float g : {-0.6f, 0.0f, 0.5f, 0.9f}) {
        EXPECT_LT(direction_deviation(
                      [g](Pcg32& r) {
                          return sample_henyey_greenstein(r.next_2d(), {0, 0, 1}, g);
                      },
                      [g](Vec3 d) { return henyey_greenstein(d.z, g); }),
                  4)
            << g;
        double mean = 0;
        Pcg32 random(3, 0);
        for (int i = 0; i < kSamples; ++i) mean += sample_henyey_greenstein_cosine(random.next_1d(), g);
        EXPECT_NEAR(mean / kSamples, g, 0.006) << g;
    }
}

TEST(Sampling, visible_normals_follow_their_density_from_every_side) {
    for (const float alpha : {0.2f, 0.5f, 1.0f})
        for (const float angle : {0.0f, 0.7f, 1.4f}) {
            const Vec3 eye{std::sin(angle) * 0.6f, std::sin(angle) * 0.8f, std::cos(angle)};
            EXPECT_LT(direction_deviation(
                          [&](Pcg32& r) { return sample_ggx_visible_normal(r.next_2d(), eye, alpha); },
                          [&](Vec3 h) { return h.z > 0 ? ggx_visible_normal_density(h, eye, alpha) : 0; }),
                      4.5)
                << alpha << " " << angle;
        }
}

TEST(Sampling, free_paths_are_exponential) {
    constexpr int kBoxes = 60;
    for (const float sigma : {0.3f, 2.0f}) {
        std::vector<double> observed(kBoxes + 1), expected(kBoxes + 1);
        Pcg32 random(11, 0);
        for (int i = 0; i < kSamples; ++i) {
            const float t = sample_exponential_mm(random.next_1d(), sigma) * sigma;
            ++observed[size_t(std::min(int(t * 10), kBoxes))];
        }
        for (int i = 0; i < kBoxes; ++i)
            expected[size_t(i)] = kSamples * (std::exp(-i / 10.0) - std::exp(-(i + 1) / 10.0));
        expected[kBoxes] = kSamples * std::exp(-kBoxes / 10.0);
        EXPECT_LT(chi_squared_deviation(observed, expected), 4) << sigma;
    }
}

TEST(Sampling, the_disk_is_even) {
    constexpr int kCells = 12;
    std::vector<double> observed(kCells * kCells),
        expected(kCells * kCells, double(kSamples) / (kCells * kCells));
    Pcg32 random(5, 0);
    for (int i = 0; i < kSamples; ++i) {
        const Vec2 p = sample_disk(random.next_2d());
        const float r2 = dot(p, p), a = std::atan2(p.y, p.x) / (2 * kPi) + 0.5f;
        ASSERT_LE(r2, 1.0001f);
        ++observed[size_t(std::min(int(r2 * kCells), kCells - 1) * kCells +
                          std::min(int(a * kCells), kCells - 1))];
    }
    EXPECT_LT(chi_squared_deviation(observed, expected), 4);
}

TEST(Sampling, frames_are_orthonormal_and_right_handed) {
    Pcg32 random(1, 0);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 n = i == 0 ? Vec3{0, 0, -1} : i == 1 ? Vec3{0, 0, 1} : sample_sphere(random.next_2d());
        const LocalFrame f = frame_of(n);
        EXPECT_NEAR(length(cross(f.tangent, f.bitangent) - n), 0, 2e-6f);
        EXPECT_NEAR(dot(f.tangent, f.bitangent), 0, 2e-6f);
        EXPECT_NEAR(length(f.to_world(f.to_local({0.1f, -0.7f, 0.4f})) - Vec3{0.1f, -0.7f, 0.4f}), 0, 2e-6f);
    }
}

TEST(Random, every_power_of_two_of_owen_points_fills_the_elementary_boxes) {
    for (const uint32_t seed : {1u, 99u, 12345u})
        for (int pair = 0; pair < 3; ++pair)
            for (const auto& [columns, rows] : {std::pair{64, 1}, {1, 64}, {8, 8}, {16, 4}, {4, 16}}) {
                std::set<int> boxes;
                for (uint32_t i = 0; i < 64; ++i) {
                    OwenSequence sequence(seed, i);
                    Vec2 u;
                    for (int p = 0; p <= pair; ++p) u = sequence.next_2d();
                    boxes.insert(int(u.x * float(columns)) * rows + int(u.y * float(rows)));
                }
                EXPECT_EQ(boxes.size(), 64u)
                    << columns << "x" << rows << " seed " << seed << " pair " << pair;
            }
}

// References that are kept, and parts that are merged, were made with these points.
TEST(Random, owen_points_stay_what_they_are) {
    const struct {
        uint32_t index;
        Vec2 first;
        float one;
        Vec2 third;
    } kPoints[] = {{0, {0x1.18c36p-3f, 0x1.4cba6ap-1f}, 0x1.d94512p-1f, {0x1.de5ae4p-2f, 0x1.af918p-5f}},
                   {1, {0x1.c06664p-1f, 0x1.aef8p-11f}, 0x1.526d3p-2f, {0x1.886636p-1f, 0x1.570436p-1f}},
                   {5, {0x1.7eca8ap-1f, 0x1.26075p-2f}, 0x1.65d88ep-1f, {0x1.6d27fcp-1f, 0x1.aad6e4p-1f}},
                   {1000, {0x1.996cap-4f, 0x1.3c43f4p-1f}, 0x1.dcbf26p-1f, {0x1.47628p-5f, 0x1.72948p-5f}}};
    for (const auto& expected : kPoints) {
        OwenSequence sequence(7, expected.index);
        EXPECT_EQ(sequence.next_2d(), expected.first) << expected.index;
        EXPECT_EQ(sequence.next_1d(), expected.one) << expected.index;
        EXPECT_EQ(sequence.next_2d(), expected.third) << expected.index;
    }
}

TEST(Random, seeds_and_pairs_are_uncorrelated) {
    double sum = 0;
    constexpr int kCount = 20'000;
    for (uint32_t i = 0; i < kCount; ++i) {
        OwenSequence a(i, 0), b(i + 1, 0);
        const Vec2 first = a.next_2d(), second = a.next_2d(), other = b.next_2d();
        sum += (first.x - 0.5) * (second.x - 0.5) + (first.x - 0.5) * (other.x - 0.5) +
               (first.x - 0.5) * (first.y - 0.5);
    }
    EXPECT_NEAR(sum / kCount, 0, 4 * std::sqrt(3.0) / 12 / std::sqrt(double(kCount)));
}

}  // namespace
}  // namespace dermis
