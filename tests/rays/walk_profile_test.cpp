#include "dermis/rays/walk_profile.h"

#include <gtest/gtest.h>

#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/random_walk.h"

namespace dermis {
namespace {

constexpr int kProfileWalks = 90'000;

Profile fitted(const ScatteringMedium& medium, uint32_t seed = 1) {
    const auto profile = fit_walk_profile(medium, kProfileWalks, seed);
    EXPECT_TRUE(profile) << profile.error().message;
    return *profile;
}

TEST(WalkProfile, has_the_albedo_and_mean_radius_of_plain_walks) {
    const ScatteringMedium medium = walk_medium_of(*find_profile("jensen_skin1"));
    const Profile profile = fitted(medium);
    const WalkMedium prepared = walk_medium(medium);
    double light = 0, radii_mm = 0;
    for (uint32_t i = 0; i < kProfileWalks; ++i) {
        Pcg32 random(7, i);
        const Vec3 start = sample_entry_direction({0, 0, 1}, prepared.eta, random);
        const WalkEnd end = random_walk(prepared, HalfSpace{}, {}, start, random);
        light += double(end.throughput.x);
        radii_mm += double(end.throughput.x) * std::hypot(end.p_mm.x, end.p_mm.y);
    }
    EXPECT_NEAR(diffuse_albedo(profile, kRed), light / kProfileWalks, 0.006);
    EXPECT_NEAR(mean_radius_mm(profile, kRed), radii_mm / light, 0.03 * radii_mm / light);
}

TEST(WalkProfile, follows_the_lengths_of_the_medium) {
    const ScatteringMedium medium = medium_of({0.3, 0.6, 0.8}, {1, 1, 1}, 0, 1);
    const Profile profile = fitted(medium);
    const Profile wide = fitted(medium_of({0.3, 0.6, 0.8}, {10, 10, 10}, 0, 1));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean_radius_mm(wide, c), 10 * mean_radius_mm(profile, c), 0.02 * mean_radius_mm(wide, c));
}

// Christensen and Burley fitted their length to such walks.
TEST(WalkProfile, is_near_burley_s_where_burley_s_was_fitted_and_another_seed_is_nearer) {
    const BurleyProfile burley{.albedo = {0.3, 0.5, 0.7}, .d_mm = {1, 1, 1}};
    const ScatteringMedium medium = medium_of(burley, 0, 1);
    const Profile by_walks = fitted(medium), other = fitted(medium, 2);
    for (int c = 0; c < 3; ++c) {
        const ProfileError error = error_of({.name = "burley", .source = {}, .model = burley}, by_walks, c);
        const ProfileError noise = error_of(other, by_walks, c);
        EXPECT_LT(error.light_at_distance, 0.03) << c;
        EXPECT_LT(noise.light_at_distance, 0.01) << c;
        EXPECT_NEAR(noise.r90_ratio, 1, 0.03) << c;
    }
    // The comparison can fail.
    const BurleyProfile wrong{.albedo = burley.albedo, .d_mm = {2, 2, 2}};
    EXPECT_GT(error_of({.name = "wrong", .source = {}, .model = wrong}, by_walks, 0).light_at_distance, 0.1);
}

TEST(WalkProfile, what_cannot_be_walked_is_named) {
    const ScatteringMedium medium = medium_of({0.3, 0.6, 0.8}, {1, 1, 1}, 0, 1);
    EXPECT_FALSE(fit_walk_profile(medium, 10, 1));
    ScatteringMedium bad = medium;
    bad.g = 2;
    EXPECT_FALSE(fit_walk_profile(bad, 3000, 1));
    bad = {.sigma_s_per_mm = {0, 0, 0}, .sigma_a_per_mm = {1, 1, 1}, .g = 0, .eta = 1};
    EXPECT_FALSE(fit_walk_profile(bad, 3000, 1)) << "no light comes back";
}

}  // namespace
}  // namespace dermis
