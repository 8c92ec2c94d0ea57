// The walk's effect of scattering: walks that let in all light, less the picture of `lambert`. As for the
// surface's: another seed has all of it, a part has its part, lambert has none, flat skin shows none.

#include "dermis/judge/comparison.h"
#include "judge/exact_shares.h"
#include "render/render_test.h"

using namespace dermis;

namespace {

constexpr int kWalkSide = 4, kWalkGrid = 2;

class WalkEffect : public RenderTest {
  protected:
    static EffectReferenceSettings settings_of(double noise, uint32_t seed) {
        EffectReferenceSettings settings{.reference = comparison_settings(kWalkSide, kWalkSide).reference,
                                         .noise = noise,
                                         .samples = 4096};
        settings.reference.integrator = Integrator::walk;
        settings.reference.grid = kWalkGrid;
        settings.reference.probes = 512;
        settings.reference.seed = seed;
        return settings;
    }

    static ComparisonSettings comparison_by_walk(int side, int walks, int samples) {
        ComparisonSettings settings = comparison_settings(side, side);
        settings.grid = kWalkGrid;
        settings.walks = walks;
        settings.samples = samples;
        settings.noise = 0.1;
        settings.frames = 0;
        settings.reference.integrator = Integrator::walk;
        return settings;
    }

    static EffectReference reference_of(const Scene& scene, const EffectReferenceSettings& settings) {
        auto reference = make_effect_reference(scene, settings);
        EXPECT_TRUE(reference) << reference.error().message;
        return std::move(*reference);
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

    // A refracting medium, whose walks differ from lambert's light by Fresnel's factor unless all light
    // enters.
    static Scene sphere() {
        Scene scene = unit_case("sphere").scene;
        scene.skin.profile = "jensen_skin1";
        return scene;
    }
};

}  // namespace

TEST_F(WalkEffect, another_seed_has_all_of_it_and_a_part_has_its_part) {
    const EffectReference reference = reference_of(sphere(), settings_of(0.01, 1)),
                          other = reference_of(sphere(), settings_of(0.01, 2));
    const Image skin = whole(reference);
    const auto share = [&](float by) {
        const auto found =
            captured({scaled(other.effect.a, by), scaled(other.effect.b, by)}, reference.effect, skin);
        EXPECT_TRUE(found);
        return found->all;
    };
    EXPECT_GT(share(1).share + share(1).error, 0.99) << share(1).share << " +- " << share(1).error;
    EXPECT_GT(share(1).share, 0.98);
    EXPECT_NEAR(share(0.9f).share, 0.9, 0.02) << "+- " << share(0.9f).error;
    EXPECT_NEAR(share(0.5f).share, 0.5, 0.015) << "+- " << share(0.5f).error;
    EXPECT_EQ(share(0).share, 0) << "lambert";
}

// Plates, strips and reliefs are sheets: without a body behind them half of the light would be lost there.
TEST_F(WalkEffect, no_walk_is_lost_in_a_unit_scene_and_flat_skin_in_full_light_has_no_effect) {
    EffectReferenceSettings settings = settings_of(1, 1);
    settings.reference.probes = 64;
    settings.samples = 2 * kWalkGrid * kWalkGrid;
    for (const std::string name : {"sphere", "cylinder", "saddle", "shadow_edge", "albedo_step", "strip",
                                   "slab_behind", "relief_1mm"}) {
        const EffectReference reference = reference_of(unit_case(name).scene, settings);
        for (const std::string& warning : reference.warnings)
            EXPECT_EQ(warning.find("were lost"), std::string::npos) << name << ": " << warning;
    }
    const Scene blur = unit_case("sphere").scene;  // the profile has no volume
    const std::vector<std::string> warnings = reference_of(blur, settings).warnings;
    EXPECT_EQ(warnings.size(), 1u);
    EXPECT_EQ(reference_of(blur, settings).warnings, warnings) << "from the cache";
    Scene flat = unit_case("shadow_edge").scene;
    std::erase_if(flat.objects, [](const SceneObject& object) { return object.name == "board"; });
    settings.reference.probes = 4096;
    const EffectReference reference = reference_of(flat, settings);
    EXPECT_LT(reference.noise.effect_rms, 0.02);
}

// The picture of width 0 is the limit of the walk's own pictures. Where only Fresnel's part enters it is not.
TEST_F(WalkEffect, walks_of_a_small_width_draw_the_picture_of_lambert) {
    const auto share_left = [&](LightEntry entry) {
        EffectReferenceSettings settings = settings_of(0.01, 1);
        const EffectReference full = reference_of(sphere(), settings);
        settings.reference.width_scale = 0.01;
        settings.reference.probes = 256;
        settings.samples = 16;
        settings.reference.entry = entry;
        const EffectReference narrow = reference_of(sphere(), settings);
        return effect_noise(narrow.effect, whole(narrow)).effect_rms /
               effect_noise(full.effect, whole(full)).effect_rms;
    };
    EXPECT_LT(share_left(LightEntry::all), 0.02);
    EXPECT_GT(share_left(LightEntry::fresnel), 0.1) << "the test cannot tell";
}

// Deep skin under oblique light returns as much as lambert's: the normalisation has the same boundary.
TEST_F(WalkEffect, flat_skin_shows_none) {
    Scene scene = unit_case("slab_behind").scene;
    scene.skin.profile = "jensen_skin1";
    // The light shines on the side that the camera sees, 60 degrees from its normal.
    Vec3& to_light = scene.lights.front().to_light_world;
    to_light = normalize(Vec3{0.866f, 0, 0.5f});
    // Walks are short beside the slab.
    EffectReferenceSettings settings = settings_of(0.001, 1);
    settings.reference.width_scale = 0.02;
    settings.reference.probes = 256;
    settings.samples = 64;
    const EffectReference reference = reference_of(scene, settings);
    const Image effect = mean_effect(reference.effect), picture = reference.radiance();
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0, light = 0;
        for (size_t y = 1; y < 3; ++y)
            for (size_t x = 1; x < 3; ++x) {
                sum += effect.floats()[3 * (y * kWalkSide + x) + c];
                light += picture.floats()[4 * (y * kWalkSide + x) + c];
            }
        EXPECT_GT(light, 0.1);
        EXPECT_LT(std::abs(sum), 0.004 * light) << c;
    }
}

TEST_F(WalkEffect, both_references_judge_each_technique) {
    const auto list =
        parse_technique_list(built_in_catalog().techniques, "lambert,preintegrated[gain=none],preintegrated");
    ASSERT_TRUE(list);
    ComparisonSettings settings = comparison_by_walk(24, 16, 256);
    settings.second = Integrator::surface;
    const auto both = compare_techniques(device(), built_in_catalog(), sphere(), *list, settings);
    ASSERT_TRUE(both) << both.error().message;
    const auto share = [&](size_t row, Integrator integrator) {
        const Judgement* found = judgement_by(integrator, *both, both->rows[row]);
        EXPECT_TRUE(found);
        return found->captured.all.share;
    };
    EXPECT_EQ(share(0, Integrator::walk), 0);
    EXPECT_EQ(share(0, Integrator::surface), 0);
    EXPECT_GT(share(1, Integrator::surface), 0.9);
    EXPECT_LT(share(1, Integrator::walk), 0.9) << "a profile is not transport";
    EXPECT_EQ(share(2, Integrator::surface), share(1, Integrator::surface)) << "it judges the profile's part";
    EXPECT_GT(share(2, Integrator::walk), share(1, Integrator::walk) + 0.1);
    const std::vector<ScoreRow> rows = score_rows("sphere", *both);
    EXPECT_EQ(rows[1].walk->all.share, share(1, Integrator::walk));
    EXPECT_EQ(rows[1].surface->all.share, share(1, Integrator::surface));
    // One reference alone leaves the other's columns empty.
    settings.second = {};
    const auto one = compare_techniques(device(), built_in_catalog(), sphere(), *list, settings);
    ASSERT_TRUE(one);
    EXPECT_EQ(judgement_by(Integrator::surface, *one, one->rows[1]), nullptr);
    EXPECT_EQ(judgement_by(Integrator::walk, *one, one->rows[1])->captured.all.share,
              share(1, Integrator::walk));
    EXPECT_FALSE(score_rows("sphere", *one)[1].surface);
}

// The map's gain contains the light through thin parts, and the technique adds light from behind. Twice the
// same light would be too much: the share would fall.
TEST_F(WalkEffect, the_walked_gain_and_transmission_count_no_light_twice) {
    const auto list = parse_technique_list(built_in_catalog().techniques,
                                           "lambert,preintegrated[gain=none],preintegrated[gain=map]");
    ASSERT_TRUE(list);
    const ComparisonSettings settings = comparison_by_walk(12, 64, 64);
    Scene slab = unit_case("slab_behind").scene;
    slab.skin.profile = "openpbr_skin_3";
    const auto compared = compare_techniques(device(), built_in_catalog(), slab, *list, settings);
    ASSERT_TRUE(compared) << compared.error().message;
    const auto share = [&](size_t row) {
        return judgement_by(Integrator::walk, *compared, compared->rows[row])->captured.all.share;
    };
    EXPECT_NEAR(share(1), 0.43, 0.05);
    EXPECT_GT(share(2), share(1) + 0.1);
}
