// One sphere under one light: the table of `preintegrated` is the exact answer, so that all of the effect
// must be captured.

#include "dermis/judge/comparison.h"
#include "dermis/judge/effect_reference.h"
#include "render/render_test.h"
#include "subjects/spheres/spheres.h"
#include "subjects/unit/exact.h"

using namespace dermis;

namespace {

class SphereShares : public RenderTest {
  protected:
    static Scene one_sphere(size_t which) {
        Scene scene = load("builtin:spheres");
        std::swap(scene.objects[0], scene.objects[which]);
        scene.objects.resize(1);
        const float radius_mm = kSphereRadiiMm[which];
        Vec3 low = scene.objects[0].mesh.positions_mm[0], high = low;
        for (const Vec3 p : scene.objects[0].mesh.positions_mm) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        scene.camera = framing_camera((low + high) * 0.5f, radius_mm);
        fit_depth_range(scene.camera, (low + high) * 0.5f, radius_mm);
        scene.environment.kind = EnvironmentKind::none;
        return scene;
    }

    static Image exact_effect_of(const Scene& scene, float radius_mm, const ComparisonSettings& settings) {
        const auto exact =
            unit::exact_sphere(scene.camera.target_mm, radius_mm, scene.key_light().to_light_world);
        const auto effect = exact_effect(scene, exact, settings.width, settings.height, settings.grid, 0);
        EXPECT_TRUE(effect) << effect.error().message;
        return *effect;
    }
};

}  // namespace

// The reference, the technique and the formula are three codes; any two of them have to agree.
TEST_F(SphereShares, preintegrated_captures_all_of_the_effect_on_a_sphere) {
    constexpr size_t kSphere = 1;
    const Scene scene = one_sphere(kSphere);
    ComparisonSettings settings = comparison_settings(48, 48);
    settings.grid = 3;
    settings.samples = 180;
    settings.noise = 0.06;
    settings.frames = 0;
    const auto list = parse_technique_list(built_in_catalog().techniques, "lambert,preintegrated");
    ASSERT_TRUE(list);
    const auto comparison = compare_techniques(device(), built_in_catalog(), scene, *list, settings);
    ASSERT_TRUE(comparison) << comparison.error().message;
    const Image& skin = comparison->masks.skin;
    const Image exact = exact_effect_of(scene, kSphereRadiiMm[kSphere], settings);
    const auto formula = captured(exact, comparison->reference.effect, skin);
    ASSERT_TRUE(formula);
    EXPECT_GT(formula->all.share, 0.97) << "the formula against the reference";
    EXPECT_LT(formula->all.error, 0.03);
    EXPECT_EQ(comparison->rows[0].first.captured.all.share, 0);
    EXPECT_GT(comparison->rows[1].first.captured.all.share, 0.97) << "the technique against the reference";
    const auto table = captured(comparison->rows[1].effect, {exact, exact}, skin);
    ASSERT_TRUE(table);
    EXPECT_GT(table->all.share, 0.98) << "the technique against the formula";
}

// The scene of the scoreboard: its spheres are so far apart that each is alone. 1.8 mm apart they were not:
// .90, as the integral reached from one to the next and their shadows' edges touched.
TEST_F(SphereShares, preintegrated_captures_all_of_the_effect_on_the_four_spheres) {
    Scene scene = load("spheres");
    // The row fills the picture, whose pixels are then nearly all skin.
    scene.camera.eye_mm = scene.camera.target_mm + (scene.camera.eye_mm - scene.camera.target_mm) * 0.42f;
    fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    ComparisonSettings settings = comparison_settings(128, 48);
    settings.noise = 0.05;
    settings.frames = 0;
    const auto list = parse_technique_list(built_in_catalog().techniques, "preintegrated");
    ASSERT_TRUE(list);
    const auto comparison = compare_techniques(device(), built_in_catalog(), scene, *list, settings);
    ASSERT_TRUE(comparison) << comparison.error().message;
    EXPECT_TRUE(comparison->reference.reached);
    const CapturedShare& share = comparison->rows[0].first.captured.all;
    EXPECT_GT(share.share, 0.97) << "+- " << share.error << ", " << comparison->reference.samples
                                 << " samples";
    EXPECT_LT(share.error, 0.03);
}
