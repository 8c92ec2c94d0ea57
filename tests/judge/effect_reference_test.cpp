// Early shares: their intervals hold the share of the finished reference, and samples that go where the noise
// is move no mean.

#include "dermis/judge/effect_reference.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "judge/exact_shares.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

constexpr int kEarlySide = 12, kEarlyGrid = 3;

// A cache of its own, so that every seed is made.
class EarlyShares : public testing::TestWithParam<Integrator> {
  protected:
    void SetUp() override { ::setenv("DERMIS_CACHE", directory_.path.c_str(), 1); }
    void TearDown() override { ::unsetenv("DERMIS_CACHE"); }

    static EffectReferenceSettings settings_of(uint32_t seed, int samples) {
        EffectReferenceSettings settings{.reference = comparison_settings(kEarlySide, kEarlySide).reference,
                                         .noise = 1e-9,
                                         .samples = samples};
        settings.reference.integrator = GetParam();
        settings.reference.grid = kEarlyGrid;
        settings.reference.probes = GetParam() == Integrator::walk ? 8 : 16;
        settings.reference.seed = seed;
        return settings;
    }
    static EffectReference reference_of(const Scene& scene, uint32_t seed, int samples) {
        auto made = make_effect_reference(scene, settings_of(seed, samples));
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }
    static Scene sphere() {
        Scene scene = unit_case("sphere").scene;
        scene.skin.profile = "openpbr_skin_3";
        return scene;
    }
    static Image whole(const EffectReference& reference) {
        Image skin = reference.skin;
        for (float& v : skin.floats()) v = v >= 1 ? 1 : 0;
        return skin;
    }
    static Image scaled(Image image, float by) {
        for (float& v : image.floats()) v *= by;
        return image;
    }

    TemporaryDirectory directory_;
};

INSTANTIATE_TEST_SUITE_P(Judges, EarlyShares, testing::Values(Integrator::surface, Integrator::walk),
                         [](const auto& of) { return std::string(judge_name(of.param)); });

}  // namespace

// Of the first samples and of four times as many, where the interval is narrow enough to be shown: 95 % of
// the seeds, within what so many can tell.
TEST_P(EarlyShares, intervals_hold_the_share_of_the_finished_reference) {
    constexpr double kShown = 0.3;
    constexpr int kSeeds = 40;
    const Scene scene = sphere();
    const EffectReference fine = reference_of(scene, 1000, 512);
    const Image mask = whole(fine), technique = scaled(mean_effect(fine.effect), 0.6f);
    int all = 0;
    for (const int samples : {2, 8}) {
        int inside = 0, shown = 0;
        for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
            const auto share = captured(technique, reference_of(scene, seed, samples).effect, mask);
            ASSERT_TRUE(share) << share.error().message;
            if (share->all.error > kShown) continue;
            ++shown;
            inside += std::abs(share->all.share - 0.6) <= share->all.error;
        }
        EXPECT_GE(inside, shown - 2 - shown / 10) << samples << " samples, " << shown << " seeds";
        all += shown;
    }
    EXPECT_GT(all, kSeeds) << "too few to tell";
}

// Means of many seeds with samples by weight, against those of the first samples, equally many a pixel.
TEST_P(EarlyShares, samples_by_weight_move_no_mean) {
    const Scene scene = sphere();
    constexpr int kSeeds = 40;
    double sums[2][6] = {}, squares[2][6] = {};
    for (uint32_t seed = 1; seed <= kSeeds; ++seed)
        for (int which = 0; which < 2; ++which) {
            // The first samples of other seeds, so that both are independent.
            const EffectReference made =
                which == 0 ? reference_of(scene, 2000 + seed, 2) : reference_of(scene, seed, 8);
            const Image mask = whole(made), mean = mean_effect(made.effect);
            for (size_t i = 0; i < 6; ++i) {
                double value = 0;
                for (size_t p = 0; p < mask.pixel_count(); ++p)
                    if (mask.floats()[p] > 0)
                        value += mean.floats()[3 * p + i % 3] *
                                 (i < 3 ? 1 : (p % kEarlySide < kEarlySide / 2 ? 1 : -1));
                sums[which][i] += value;
                squares[which][i] += value * value;
            }
        }
    for (size_t i = 0; i < 6; ++i) {
        double variance = 0;
        for (int which = 0; which < 2; ++which)
            variance +=
                (squares[which][i] - sums[which][i] * sums[which][i] / kSeeds) / (kSeeds - 1.0) / kSeeds;
        EXPECT_LT(std::abs(sums[0][i] - sums[1][i]) / kSeeds, 3.5 * std::sqrt(variance)) << i;
    }
}

TEST_P(EarlyShares, a_reference_that_is_stopped_goes_on_to_the_same_end) {
    const Scene scene = sphere();
    const EffectReference whole = reference_of(scene, 5, 40);
    const TemporaryDirectory other;
    ::setenv("DERMIS_CACHE", other.path.c_str(), 1);
    std::atomic<bool> stop = false;
    const EffectReferenceHooks hooks{
        .done = [&](double done, bool first) { stop = stop || (!first && done > 0.4); }, .stop = &stop};
    const auto stopped = make_effect_reference(scene, settings_of(5, 40), hooks);
    ASSERT_TRUE(stopped) << stopped.error().message;
    EXPECT_TRUE(stopped->stopped);
    EXPECT_FALSE(stopped->reached);
    EXPECT_LT(stopped->samples, 40);
    const EffectReference on = reference_of(scene, 5, 40);
    EXPECT_FALSE(on.stopped);
    EXPECT_EQ(on.samples, 40);
    EXPECT_GT(on.time_ms, stopped->time_ms) << "it began with what was there";
    for (size_t i = 0; i < on.effect.a.floats().size(); ++i)
        EXPECT_NEAR(on.effect.a.floats()[i], whole.effect.a.floats()[i], 1e-6) << i;
}
