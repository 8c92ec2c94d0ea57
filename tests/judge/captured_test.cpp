#include "dermis/judge/captured.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace dermis;
using testing::HasSubstr;

namespace {

constexpr int kEffectSide = 96;

// An effect as skin has it: red far above green and blue, dark on one side of an edge and bright on the
// other.
Image effect() {
    Image image(kEffectSide, kEffectSide, 3);
    constexpr float kStrength[3] = {0.012f, 0.0015f, 0.0007f};
    for (int y = 0; y < kEffectSide; ++y)
        for (int x = 0; x < kEffectSide; ++x)
            for (int c = 0; c < 3; ++c)
                image.set(x, y, c, kStrength[c] * std::sin(0.3f * float(x)) * std::exp(-0.02f * float(y)));
    return image;
}

Image with_noise(const Image& image, float sigma, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(0, sigma);
    Image result = image;
    for (float& v : result.floats()) v += normal(random);
    return result;
}

EffectHalves halves(const Image& image, float sigma, unsigned seed) {
    return {with_noise(image, sigma, 2 * seed), with_noise(image, sigma, 2 * seed + 1)};
}

Image scaled(Image image, float by) {
    for (float& v : image.floats()) v *= by;
    return image;
}

Image everywhere() {
    Image mask(kEffectSide, kEffectSide, 1);
    for (float& v : mask.floats()) v = 1;
    return mask;
}

Captured share(const Image& technique, const EffectHalves& reference) {
    const auto result = captured(technique, reference, everywhere());
    EXPECT_TRUE(result) << result.error().message;
    return *result;
}

// A fifth of the effect, as the judge asks for.
const float kNoise = 0.2f * 0.0045f;

}  // namespace

TEST(Captured, a_technique_without_effect_has_exactly_0) {
    const Captured none = share(Image(kEffectSide, kEffectSide, 3), halves(effect(), kNoise, 1));
    EXPECT_EQ(none.all.share, 0);
    for (const CapturedShare& channel : none.channels) EXPECT_EQ(channel.share, 0);
    EXPECT_LT(none.all.error, 1e-12);
    EXPECT_EQ(none.pixels, size_t(kEffectSide * kEffectSide));
}

TEST(Captured, an_effect_scaled_by_nine_tenths_has_nine_tenths_whatever_the_noise) {
    for (const float noise : {0.0f, kNoise, 3 * kNoise}) {
        const Captured most = share(scaled(effect(), 0.9f), halves(effect(), noise, 7));
        EXPECT_NEAR(most.all.share, 0.9, 0.01) << noise;
    }
    EXPECT_NEAR(share(scaled(effect(), 2), halves(effect(), kNoise, 7)).all.share, 0, 0.01);
    EXPECT_NEAR(share(scaled(effect(), -1), halves(effect(), kNoise, 7)).all.share, -1, 0.01);
}

TEST(Captured, the_reference_itself_by_another_seed_has_over_99_hundredths) {
    const auto itself =
        captured(halves(effect(), 0.1f * kNoise, 3), halves(effect(), 0.1f * kNoise, 4), everywhere());
    ASSERT_TRUE(itself);
    EXPECT_GT(itself->all.share, 0.99);
    // Were its noise not taken out, a fifth of the effect would be missing.
    const auto noisy = captured(halves(effect(), kNoise, 3), halves(effect(), kNoise, 4), everywhere());
    ASSERT_TRUE(noisy);
    EXPECT_GT(noisy->all.share, 0.94);
    EXPECT_GT(noisy->all.share + noisy->all.error, 0.99);
}

TEST(Captured, effect_and_noise_are_what_was_put_in) {
    const EffectHalves reference = halves(effect(), kNoise, 5);
    double squares = 0;
    const Image clean = effect();
    for (const float v : clean.floats()) squares += double(v) * v;
    const double rms = std::sqrt(squares / double(clean.floats().size()));
    const Captured none = share(Image(kEffectSide, kEffectSide, 3), reference);
    EXPECT_NEAR(none.all.effect_rms, rms, 0.01 * rms);
    // Of the mean of two halves.
    EXPECT_NEAR(none.all.reference_noise, kNoise / std::sqrt(2.0), 0.02 * kNoise);
    EXPECT_GT(none.channels[0].effect_rms, 5 * none.channels[1].effect_rms);
    EXPECT_NEAR(effect_noise(reference, everywhere()).noise_rms, none.all.reference_noise, 1e-12);
}

// 200 references of the same scene: the stated interval holds the share of 95 % of them, within what 200 can
// tell.
TEST(Captured, the_interval_holds_the_share_of_other_seeds) {
    for (const float part : {0.3f, 0.8f}) {
        const Image technique = scaled(effect(), part);
        int inside = 0;
        for (unsigned seed = 0; seed < 200; ++seed) {
            const CapturedShare all = share(technique, halves(effect(), 2 * kNoise, 100 + seed)).all;
            inside += std::abs(all.share - double(part)) <= all.error;
        }
        EXPECT_GE(inside, 180) << part;
        EXPECT_LE(inside, 199) << part;
    }
}

TEST(Captured, a_share_of_a_reference_that_is_too_noisy_is_not_printed) {
    EXPECT_TRUE(share(scaled(effect(), 0.5f), halves(effect(), kNoise, 1)).all.known());
    const Captured noisy = share(scaled(effect(), 0.5f), halves(effect(), 60 * kNoise, 1));
    EXPECT_FALSE(noisy.all.known());
    // Nothing scatters: there is nothing to have a share of.
    const Captured nothing =
        share(effect(), {Image(kEffectSide, kEffectSide, 3), Image(kEffectSide, kEffectSide, 3)});
    EXPECT_FALSE(nothing.all.known());
}

TEST(Captured, only_the_mask_counts) {
    Image technique = effect();
    Image mask = everywhere();
    for (int x = 0; x < kEffectSide; ++x) {
        technique.set(x, 3, 0, 100);
        mask.set(x, 3, 0, 0);
    }
    const auto result = captured(technique, {effect(), effect()}, mask);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->all.share, 1);
    EXPECT_EQ(result->pixels, size_t(kEffectSide * (kEffectSide - 1)));
}

TEST(Captured, what_cannot_be_measured_is_refused) {
    const EffectHalves reference = {effect(), effect()};
    EXPECT_THAT(captured(Image(8, 8, 3), reference, everywhere()).error().message,
                HasSubstr("differ in size"));
    EXPECT_THAT(captured(effect(), reference, Image(kEffectSide, kEffectSide, 1)).error().message,
                HasSubstr("mask is empty"));
    Image broken = effect();
    broken.set(1, 1, 1, std::numeric_limits<float>::quiet_NaN());
    EXPECT_THAT(captured(broken, reference, everywhere()).error().message, HasSubstr("NaN"));
}

TEST(ShareChange, is_the_difference_of_both_shares_with_less_noise_than_either) {
    const Image whole = effect(), most = scaled(whole, 0.8f), more = scaled(whole, 0.81f);
    const EffectHalves noisy = halves(whole, 3 * kNoise, 5);
    const auto change = share_change(most, more, noisy, everywhere());
    ASSERT_TRUE(change) << change.error().message;
    EXPECT_NEAR(change->change, share(more, noisy).all.share - share(most, noisy).all.share, 1e-12);
    EXPECT_NEAR(change->change, 0.01, 2 * change->error);
    EXPECT_LT(change->error, 0.3 * share(most, noisy).all.error);
    const auto same = share_change(most, most, noisy, everywhere());
    ASSERT_TRUE(same);
    EXPECT_EQ(same->change, 0);
    EXPECT_EQ(same->error, 0);
}

TEST(ShareChange, lies_within_its_interval_for_most_seeds) {
    const Image whole = effect(), most = scaled(whole, 0.7f), more = scaled(whole, 0.75f);
    int inside = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        const auto change = share_change(most, more, halves(whole, 2 * kNoise, seed), everywhere());
        ASSERT_TRUE(change);
        inside += int(std::abs(change->change - 0.05) <= change->error);
    }
    EXPECT_GE(inside, 52);
}
