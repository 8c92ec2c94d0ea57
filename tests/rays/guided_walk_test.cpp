#include "dermis/rays/guided_walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"

namespace dermis {
namespace {

// Between z = -thickness and z = 0.
struct Slab {
    float thickness_mm;
    std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm) const {
        if (direction.z == 0) return std::nullopt;
        const bool up = direction.z > 0;
        const float distance_mm =
            std::max(0.0f, (up ? -p_mm.z : p_mm.z + thickness_mm) / std::abs(direction.z));
        if (distance_mm > max_mm) return std::nullopt;
        return BoundaryHit{distance_mm, {0, 0, up ? 1.0f : -1.0f}};
    }
};

// Of radius r about (0, 0, -r).
struct Ball {
    float radius_mm;
    std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm) const {
        const Vec3 from = p_mm + Vec3{0, 0, radius_mm};
        const float b = dot(from, direction), c = dot(from, from) - radius_mm * radius_mm;
        const float distance_mm = std::max(0.0f, -b + std::sqrt(std::max(0.0f, b * b - c)));
        if (distance_mm > max_mm) return std::nullopt;
        return BoundaryHit{distance_mm, normalize(from + direction * distance_mm)};
    }
};

ScatteringMedium skin(double eta, double g = 0) {
    ScatteringMedium medium = std::get<DipoleProfile>(find_profile("jensen_skin1")->model).medium;
    medium.eta = eta;
    medium.g = g;
    for (double& sigma : medium.sigma_s_per_mm) sigma /= 1 - g;
    return medium;
}

// Measured light: all of it, the part that leaves far away, the part that leaves on the other side. Nine
// numbers.
struct Measured {
    double sum[9] = {}, squares[9] = {};
    int groups = 0;

    // One walk led by each channel.
    void add(const WalkEnd (&ends)[3]) {
        double values[9] = {};
        for (const WalkEnd& end : ends) add_to(values, end);
        for (int i = 0; i < 9; ++i) {
            sum[i] += values[i];
            squares[i] += values[i] * values[i];
        }
        ++groups;
    }
    static void add_to(double (&values)[9], const WalkEnd& end) {
        const double far = std::hypot(end.p_mm.x, end.p_mm.y) > 2, behind = end.p_mm.z < -1;
        const double carried[3] = {end.throughput.x, end.throughput.y, end.throughput.z};
        for (int c = 0; c < 3; ++c) {
            values[c] += carried[c] / 3;
            values[3 + c] += carried[c] * far / 3;
            values[6 + c] += carried[c] * behind / 3;
        }
    }
    [[nodiscard]] double mean(int i) const { return sum[i] / groups; }
    [[nodiscard]] double variance(int i) const { return squares[i] / groups - mean(i) * mean(i); }
    [[nodiscard]] double variance_of_mean(int i) const { return variance(i) / groups; }
};

template <class Boundary>
Measured measure(const ScatteringMedium& medium, const Boundary& boundary, bool guided, int walks) {
    const WalkMedium prepared = walk_medium(medium);
    const WalkGuide guide = walk_guide(medium);
    Measured measured;
    for (int i = 0; i + 2 < walks; i += 3) {
        WalkEnd ends[3];
        for (int hero = 0; hero < 3; ++hero) {
            Pcg32 random(guided ? 1 : 2, uint32_t(i + hero));
            const Vec3 n{0, 0, 1}, start = sample_entry_direction(n, prepared.eta, random);
            ends[hero] = guided ? guided_walk(prepared, guide, boundary, {}, n, start,
                                              (float(hero) + 0.5f) / 3, random)
                                : random_walk(prepared, boundary, {}, start, random);
        }
        measured.add(ends);
    }
    return measured;
}

// Compared with the plain walk.
template <class Boundary>
void expect_the_same_means(const ScatteringMedium& medium, const Boundary& boundary, int walks = 80'000) {
    const Measured plain = measure(medium, boundary, false, walks),
                   guided = measure(medium, boundary, true, walks);
    for (int i = 0; i < 9; ++i) {
        const double error = std::sqrt(plain.variance_of_mean(i) + guided.variance_of_mean(i));
        EXPECT_LT(std::abs(plain.mean(i) - guided.mean(i)), 4 * error + 1e-6)
            << "number " << i << ": " << plain.mean(i) << " and " << guided.mean(i) << " +- " << error;
    }
}

TEST(GuidedWalk, has_the_means_of_the_plain_walk_in_a_half_space) {
    for (const double eta : {1.0, 1.3, 1.5}) expect_the_same_means(skin(eta), HalfSpace{});
}

TEST(GuidedWalk, has_the_means_of_the_plain_walk_through_a_thin_slab) {
    for (const double eta : {1.0, 1.4}) expect_the_same_means(skin(eta), Slab{1.5f});
}

TEST(GuidedWalk, has_the_means_of_the_plain_walk_in_a_ball) {
    for (const double eta : {1.0, 1.3}) expect_the_same_means(skin(eta), Ball{2});
}

TEST(GuidedWalk, has_the_means_of_the_plain_walk_whatever_the_phase_function) {
    for (const double g : {-0.5, 0.4, 0.8}) expect_the_same_means(skin(1.3, g), HalfSpace{});
    expect_the_same_means(skin(1.3, 0.8), Slab{1.5f});
}

TEST(GuidedWalk, has_the_means_of_the_plain_walk_in_light_skin) {
    for (const char* name : {"openpbr_skin_1", "unreal_default"}) {
        const ScatteringMedium medium = walk_medium_of(*find_profile(name));
        expect_the_same_means(medium, HalfSpace{}, 20'000);
        expect_the_same_means(medium, Ball{8}, 20'000);
    }
}

TEST(GuidedWalk, copes_without_scattering_and_without_absorption) {
    const ScatteringMedium black{.sigma_s_per_mm = {0, 0, 0}, .sigma_a_per_mm = {1, 2, 3}, .g = 0, .eta = 1};
    EXPECT_EQ(measure(black, HalfSpace{}, true, 1000).mean(0), 0);
    const ScatteringMedium white{
        .sigma_s_per_mm = {1, 2, 3}, .sigma_a_per_mm = {0, 0, 0}, .g = 0, .eta = 1.3};
    const Measured all = measure(white, Ball{2}, true, 20'000);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(all.mean(c), 1, 4 * std::sqrt(all.variance_of_mean(c)) + 1e-3);
}

TEST(GuidedWalk, a_half_space_of_skin_has_less_than_half_of_the_variance) {
    const Measured plain = measure(skin(1.3), HalfSpace{}, false, 40'000);
    const Measured guided = measure(skin(1.3), HalfSpace{}, true, 40'000);
    EXPECT_LT(guided.variance(0), 0.5 * plain.variance(0));
    EXPECT_LT(guided.variance(1), 0.3 * plain.variance(1));
    EXPECT_LT(guided.variance(2), 0.4 * plain.variance(2));
}

TEST(GuidedWalk, a_pair_differs_by_the_mean_of_separate_walks_with_less_noise) {
    for (const double eta : {1.0, 1.3}) {
        const ScatteringMedium medium = skin(eta);
        const WalkMedium prepared = walk_medium(medium);
        const WalkGuide guide = walk_guide_of_pairs(medium);
        const Ball ball{40};
        const int walks = 39'999;
        Measured differences;
        WalkEnd ends[3];
        for (int i = 0; i < walks; ++i) {
            Pcg32 random(5, uint32_t(i));
            const Vec3 n{0, 0, 1}, start = sample_entry_direction(n, prepared.eta, random);
            const float lead = golden_1d(0, uint32_t(i));
            const WalkPair pair = guided_walk_and_flat(prepared, guide, ball, {}, n, start, lead, random);
            ends[i % 3] = pair.end;
            ends[i % 3].throughput -= pair.flat.throughput;
            if (i % 3 == 2) differences.add(ends);
        }
        const Measured separate = measure(medium, ball, true, walks),
                       flat = measure(medium, HalfSpace{}, false, walks);
        for (int c = 0; c < 3; ++c) {
            const double error = std::sqrt(differences.variance_of_mean(c) + separate.variance_of_mean(c) +
                                           flat.variance_of_mean(c));
            EXPECT_LT(std::abs(differences.mean(c) - (separate.mean(c) - flat.mean(c))), 4 * error)
                << eta << ", " << c;
            EXPECT_LT(differences.variance(c), 0.5 * separate.variance(c)) << eta << ", " << c;
        }
    }
}

// Guided steps alone had single walks of a thousand times the mean in a ball, so that the spread of some
// thousand walks did not show the error of their mean.
TEST(GuidedWalk, no_walk_in_a_ball_carries_more_than_a_plain_one_over_the_part_of_plain_ones) {
    const ScatteringMedium medium = skin(1.3);
    const WalkMedium prepared = walk_medium(medium);
    const WalkGuide guide = walk_guide(medium);
    float most = 0;
    for (int i = 0; i < 60'000; ++i) {
        Pcg32 random(3, uint32_t(i));
        const Vec3 n{0, 0, 1}, start = sample_entry_direction(n, prepared.eta, random);
        const Vec3 t = guided_walk(prepared, guide, Ball{10}, {}, n, start, (float(i % 3) + 0.5f) / 3, random)
                           .throughput;
        most = std::max({most, t.x, t.y, t.z});
    }
    // A plain walk is led by three channels in turn.
    EXPECT_LT(most, 3 / kPlainWalks * 1.01f);
    EXPECT_GT(most, 0.5f);
}

TEST(GuidedWalk, the_albedo_of_a_half_space_is_that_of_plain_walks) {
    const HalfSpaceAlbedo plain = half_space_albedo(skin(1.3), std::nullopt, 60'000, 1),
                          guided = guided_half_space_albedo(skin(1.3), 60'000, 2);
    for (float Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        EXPECT_LT(std::abs(plain.mean.*c - guided.mean.*c),
                  4 * std::hypot(plain.standard_error.*c, guided.standard_error.*c));
        EXPECT_LT(guided.standard_error.*c, plain.standard_error.*c);
    }
}

TEST(GuidedWalk, the_diffusion_length_solves_its_equation_and_nears_that_of_diffusion) {
    for (const double albedo : {0.5, 0.8, 0.99}) {
        const double nu = diffusion_length_in_paths(albedo);
        EXPECT_NEAR(albedo * nu / 2 * std::log((nu + 1) / (nu - 1)), 1, 1e-6) << albedo;
    }
    EXPECT_NEAR(diffusion_length_in_paths(0.999), 1 / std::sqrt(3 * 0.001), 0.1);
}

}  // namespace
}  // namespace dermis
