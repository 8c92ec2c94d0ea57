#include "dermis/rays/random_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dermis/base/parallel.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"

namespace dermis {
namespace {

// Chandrasekhar's H for isotropic scattering, Radiative Transfer 1950, chapter V, by the iteration
//   1 / H(mu) = sqrt(1 - alpha) + alpha / 2 * integral of t H(t) / (mu + t) over 0..1.
class ChandrasekharH {
  public:
    explicit ChandrasekharH(double alpha) : alpha_(alpha), h_(kPoints, 1.0) {
        for (int round = 0; round < 400; ++round) {
            std::vector<double> next(kPoints);
            for (int i = 0; i < kPoints; ++i) next[size_t(i)] = at(mu(i));
            h_ = next;
        }
    }
    [[nodiscard]] double at(double m) const {
        double sum = 0;
        for (int i = 0; i < kPoints; ++i) sum += mu(i) * h_[size_t(i)] / (m + mu(i)) / kPoints;
        return 1 / (std::sqrt(1 - alpha_) + alpha_ / 2 * sum);
    }
    [[nodiscard]] double plane_albedo(double m) const { return 1 - at(m) * std::sqrt(1 - alpha_); }
    // Of diffuse light: 2 * integral of mu * plane albedo.
    [[nodiscard]] double spherical_albedo() const {
        double sum = 0;
        for (int i = 0; i < kPoints; ++i) sum += 2 * mu(i) * plane_albedo(mu(i)) / kPoints;
        return sum;
    }

  private:
    static constexpr int kPoints = 400;
    static double mu(int i) { return (i + 0.5) / kPoints; }
    double alpha_;
    std::vector<double> h_;
};

ScatteringMedium medium_of_albedo(double red, double green, double blue, double eta) {
    return {.sigma_s_per_mm = {red, 2 * green, 0.5 * blue},
            .sigma_a_per_mm = {1 - red, 2 * (1 - green), 0.5 * (1 - blue)},
            .g = 0,
            .eta = eta};
}

TEST(RandomWalk, the_test_s_own_h_function_has_the_known_moment) {
    // Integral of H over 0..1 is 2 / alpha * (1 - sqrt(1 - alpha)).
    const double alpha = 0.8;
    const ChandrasekharH h(alpha);
    double sum = 0;
    for (int i = 0; i < 400; ++i) sum += h.at((i + 0.5) / 400) / 400;
    EXPECT_NEAR(sum, 2 / alpha * (1 - std::sqrt(1 - alpha)), 2e-4);
}

TEST(RandomWalk, an_index_matched_isotropic_half_space_reflects_what_chandrasekhar_says) {
    const ScatteringMedium medium = medium_of_albedo(0.5, 0.8, 0.95, 1);
    const double alpha[3] = {0.5, 0.8, 0.95};
    for (const double mu : {0.2, 0.6, 1.0}) {
        const Vec3 start{float(std::sqrt(1 - mu * mu)), 0, float(-mu)};
        const HalfSpaceAlbedo albedo = half_space_albedo(medium, start, 150'000, 1);
        const float mean[3] = {albedo.mean.x, albedo.mean.y, albedo.mean.z};
        const float error[3] = {albedo.standard_error.x, albedo.standard_error.y, albedo.standard_error.z};
        for (int c = 0; c < 3; ++c) {
            const double exact = ChandrasekharH(alpha[c]).plane_albedo(mu);
            EXPECT_NEAR(mean[c], exact, 0.01 * exact) << "mu " << mu << " alpha " << alpha[c];
            EXPECT_LT(std::abs(mean[c] - exact), 4 * error[c]) << "mu " << mu << " alpha " << alpha[c];
        }
    }
}

TEST(RandomWalk, diffuse_light_on_an_index_matched_half_space_gives_the_spherical_albedo) {
    const HalfSpaceAlbedo albedo =
        half_space_albedo(medium_of_albedo(0.5, 0.8, 0.95, 1), std::nullopt, 150'000, 2);
    EXPECT_NEAR(albedo.mean.x, ChandrasekharH(0.5).spherical_albedo(), 4 * albedo.standard_error.x);
    EXPECT_NEAR(albedo.mean.y, ChandrasekharH(0.8).spherical_albedo(), 4 * albedo.standard_error.y);
    EXPECT_NEAR(albedo.mean.z, ChandrasekharH(0.95).spherical_albedo(), 4 * albedo.standard_error.z);
}

TEST(RandomWalk, more_absorption_less_albedo_whatever_the_boundary) {
    for (const double eta : {1.0, 1.3, 1.5}) {
        const Vec3 albedo =
            half_space_albedo(medium_of_albedo(0.9, 0.7, 0.4, eta), std::nullopt, 20'000, 3).mean;
        EXPECT_GT(albedo.x, albedo.y + 0.05f) << eta;
        EXPECT_GT(albedo.y, albedo.z + 0.02f) << eta;
    }
}

TEST(RandomWalk, without_scattering_nothing_comes_back) {
    const ScatteringMedium medium{
        .sigma_s_per_mm = {0, 0, 0}, .sigma_a_per_mm = {1, 2, 3}, .g = 0, .eta = 1.4};
    EXPECT_EQ(half_space_albedo(medium, std::nullopt, 1000, 1).mean, (Vec3{0, 0, 0}));
}

// Jensen 2001, figure 5, gives the dipole's albedo beside the coefficients; the dipole is a diffusion
// approximation, which a walk is not. docs/figures.md has both.
TEST(RandomWalk, the_skins_of_jensen_have_the_albedo_that_the_page_says) {
    const auto expect = [](const char* name, const double(&recorded)[3]) {
        const auto profile = find_profile(name);
        ASSERT_TRUE(profile);
        const auto* dipole = std::get_if<DipoleProfile>(&profile->model);
        ASSERT_NE(dipole, nullptr);
        const HalfSpaceAlbedo albedo = half_space_albedo(dipole->medium, std::nullopt, 200'000, 1);
        const float mean[3] = {albedo.mean.x, albedo.mean.y, albedo.mean.z};
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], recorded[c], 0.004) << name << " channel " << c;
    };
    expect("jensen_skin1", {0.457, 0.227, 0.124});
    expect("jensen_skin2", {0.650, 0.454, 0.356});
}

// Albedo inversion and mean free path of dermis/optics/conversions.h against the walk itself.
TEST(RandomWalk, a_medium_made_for_a_profile_blurs_as_the_profile_does) {
    for (const double a : {0.1, 0.3, 0.5, 0.6, 0.8}) {
        const BurleyProfile burley{.albedo = {a, a, a}, .d_mm = {1, 1, 1}};
        const Profile profile{.name = "test", .source = {}, .model = burley};
        const WalkMedium medium = walk_medium(walk_medium_of(profile));
        std::vector<std::pair<double, double>> exits;  // radius, weight
        double weights = 0, radii = 0;
        constexpr int kWalks = 60'000;
        for (uint32_t i = 0; i < kWalks; ++i) {
            Pcg32 random(1, i);
            const Vec3 start = sample_entry_direction({0, 0, 1}, 1, random);
            const WalkEnd end = random_walk(medium, HalfSpace{}, {}, start, random);
            if (end.throughput.x <= 0) continue;
            exits.emplace_back(std::hypot(end.p_mm.x, end.p_mm.y), end.throughput.x);
            weights += end.throughput.x;
            radii += end.throughput.x * exits.back().first;
        }
        EXPECT_NEAR(weights / kWalks, a, 0.008) << a;
        EXPECT_NEAR(radii / weights, mean_radius_mm(profile, kRed), 0.08 * mean_radius_mm(profile, kRed))
            << a;
        std::ranges::sort(exits);
        double within = 0, worst = 0;
        for (const auto& [radius_mm, weight] : exits) {
            within += weight / weights;
            worst = std::max(worst, std::abs(within - cdf(profile, kRed, radius_mm)));
        }
        EXPECT_LT(worst, 0.03) << a;
    }
}

// Skins lighter than 0.8 are walked as they are: OpenPBR I, Unreal's default. Burley's fit of its length to
// the mean free path is off there; the walk's albedo is not.
TEST(RandomWalk, the_medium_of_a_light_skin_has_the_albedo_of_its_profile) {
    for (const char* name : {"openpbr_skin_1", "unreal_default"}) {
        const Profile profile = *find_profile(name);
        EXPECT_EQ(walk_volume_note(profile), "") << name;
        const HalfSpaceAlbedo albedo = half_space_albedo(walk_medium_of(profile), std::nullopt, 60'000, 5);
        EXPECT_GT(diffuse_albedo(profile, kRed), 0.8) << name;
        EXPECT_NEAR(albedo.mean.x, diffuse_albedo(profile, kRed), 0.008) << name;
        EXPECT_NEAR(albedo.mean.y, diffuse_albedo(profile, kGreen), 0.008) << name;
        EXPECT_NEAR(albedo.mean.z, diffuse_albedo(profile, kBlue), 0.008) << name;
    }
}

TEST(RandomWalk, a_dipole_has_its_own_medium_and_a_pure_blur_one_of_medium_albedo) {
    const ScatteringMedium skin = walk_medium_of(*find_profile("jensen_skin1"));
    EXPECT_DOUBLE_EQ(skin.eta, 1.3);
    EXPECT_DOUBLE_EQ(skin.sigma_a_per_mm[0], 0.032);
    const ScatteringMedium blur = walk_medium_of(*find_profile("gpu_gems_3"));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(multiscatter_albedo(single_scatter_albedo(blur, c), 0), 0.5, 1e-3);
    EXPECT_EQ(walk_volume_note(*find_profile("gpu_gems_3")),
              "gpu_gems_3 has no volume (albedo 1 in red, green, blue); walk takes one of albedo 0.5 and the "
              "same mean radius");
    EXPECT_EQ(walk_volume_note(*find_profile("jensen_skin1")), "");
    EXPECT_LT(mean_free_path_mm(blur, kBlue), mean_free_path_mm(blur, kRed));
}

TEST(RandomWalk, the_number_of_threads_changes_nothing) {
    const ScatteringMedium medium = medium_of_albedo(0.9, 0.7, 0.4, 1.4);
    const Vec3 all = half_space_albedo(medium, std::nullopt, 5000, 9).mean;
    set_thread_limit(1);
    EXPECT_EQ(half_space_albedo(medium, std::nullopt, 5000, 9).mean, all);
    set_thread_limit(0);
}

// A reduced medium (g = 0) and one that scatters forward with the same sigma_s' look nearly alike:
// similarity.
TEST(RandomWalk, forward_scattering_with_the_same_reduced_coefficients_looks_alike) {
    ScatteringMedium isotropic{
        .sigma_s_per_mm = {1, 1, 1}, .sigma_a_per_mm = {0.02, 0.05, 0.1}, .g = 0, .eta = 1};
    ScatteringMedium forward = isotropic;
    forward.g = 0.7;
    for (double& sigma : forward.sigma_s_per_mm) sigma /= 0.3;
    const Vec3 a = half_space_albedo(isotropic, std::nullopt, 40'000, 4).mean;
    const Vec3 b = half_space_albedo(forward, std::nullopt, 40'000, 5).mean;
    EXPECT_NEAR(a.x, b.x, 0.03);
    EXPECT_NEAR(a.z, b.z, 0.03);
}

}  // namespace
}  // namespace dermis
