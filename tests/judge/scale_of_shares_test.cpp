// The scale of the measure on real references: another seed of the reference has all of the effect, nine
// tenths of the effect have nine tenths, lambert has none.
//
// The root in the share makes a ratio of 1e-4 a hundredth, so that this takes a reference that is much finer
// than one that techniques are held against. For the same work fewer pixels tell more here.

#include <filesystem>

#include "dermis/base/file.h"
#include "judge/exact_shares.h"
#include "render/render_test.h"
#include "test_paths.h"

using namespace dermis;

namespace {

constexpr int kSide = 6, kGrid = 2;

class ScaleOfShares : public RenderTest {
  protected:
    static EffectReference reference_of(const Scene& scene, double noise, uint32_t seed) {
        EffectReferenceSettings settings{
            .reference = comparison_settings(kSide, kSide).reference, .noise = noise, .samples = 4096};
        settings.reference.grid = kGrid;
        settings.reference.probes = 512;
        settings.reference.seed = seed;
        auto reference = make_effect_reference(scene, settings);
        EXPECT_TRUE(reference) << reference.error().message;
        EXPECT_TRUE(reference->reached);
        return std::move(*reference);
    }

    static Image scaled(Image image, float by) {
        for (float& v : image.floats()) v *= by;
        return image;
    }
};

struct Shares {
    CapturedShare itself, nine_tenths, nine_tenths_of_exact;
};

class ScaleOnScene : public ScaleOfShares {
  protected:
    static Shares shares_on(const std::string& name, double noise) {
        const SubjectCase one = unit_case(name);
        const EffectReference reference = reference_of(one.scene, noise, 1),
                              other = reference_of(one.scene, noise, 2);
        Image skin = reference.skin;
        for (float& v : skin.floats()) v = v >= 1 ? 1 : 0;
        const float penumbra_mm = comparison_settings(kSide, kSide).reference.lighting.penumbra_mm;
        const auto exact = exact_effect(one.scene, one.exact, kSide, kSide, kGrid, penumbra_mm);
        const EffectHalves& effect = other.effect;
        const auto itself = captured(effect, reference.effect, skin);
        const auto part = captured({scaled(effect.a, 0.9f), scaled(effect.b, 0.9f)}, reference.effect, skin);
        const auto part_of_exact = captured(scaled(*exact, 0.9f), reference.effect, skin);
        EXPECT_TRUE(itself && part && part_of_exact);
        return {itself->all, part->all, part_of_exact->all};
    }
};

}  // namespace

TEST_F(ScaleOnScene, a_slab_lit_from_behind) {
    const Shares shares = shares_on("slab_behind", 0.004);
    EXPECT_GT(shares.itself.share, 0.99) << "+- " << shares.itself.error;
    EXPECT_NEAR(shares.nine_tenths.share, 0.9, 0.005) << "+- " << shares.nine_tenths.error;
    EXPECT_NEAR(shares.nine_tenths_of_exact.share, 0.9, 0.005) << "+- " << shares.nine_tenths_of_exact.error;
}

// Its red light reaches all of the sphere of 2 mm: the hardest of the unit scenes for the reference's
// series.
TEST_F(ScaleOnScene, a_sphere_lit_from_behind) {
    const Shares shares = shares_on("sphere_behind", 0.008);
    EXPECT_GT(shares.itself.share, 0.98) << "+- " << shares.itself.error;
    EXPECT_GT(shares.itself.share + shares.itself.error, 0.99);
    EXPECT_NEAR(shares.nine_tenths.share, 0.9, 0.01) << "+- " << shares.nine_tenths.error;
    EXPECT_NEAR(shares.nine_tenths_of_exact.share, 0.9, 0.01) << "+- " << shares.nine_tenths_of_exact.error;
}

// Every scene that comes with the program; scoreboard_test.cpp has the unit scenes.
TEST_F(ScaleOfShares, lambert_has_none_of_the_effect_on_every_scene) {
    const auto list = parse_technique_list(built_in_catalog().techniques, "lambert,wrap");
    ASSERT_TRUE(list);
    ComparisonSettings settings = comparison_settings(24, 24);
    settings.grid = kGrid;
    settings.probes = 6;
    settings.noise = 0.9;
    settings.shadow_map_size = 1024;
    settings.frames = 0;
    size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(DERMIS_SOURCE_DIR "/scenes")) {
        const auto text = read_text_file(file.path());
        ASSERT_TRUE(text);
        if (text->find("assets:") != std::string::npos) continue;
        const std::string name = file.path().stem().string();
        const auto comparison = compare_techniques(device(), built_in_catalog(), load(name), *list, settings);
        ASSERT_TRUE(comparison) << name << ": " << comparison.error().message;
        const CapturedShare &none = comparison->rows[0].first.captured.all,
                            &wrap = comparison->rows[1].first.captured.all;
        EXPECT_EQ(none.share, 0) << name;
        EXPECT_LE(none.error, 1e-9) << name;
        EXPECT_NE(wrap.share, 0) << name << ": the effect was not measured";
        ++count;
    }
    EXPECT_GE(count, 4u) << "spheres, unit, bust, backlit";
}
