// One sphere under one light: the table of `preintegrated` is the exact answer, so that all of the effect
// must be captured.

#include <cmath>

#include "dermis/judge/comparison.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"
#include "dermis/render/complete_scene.h"
#include "render/render_test.h"
#include "subjects/spheres/spheres.h"

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

    // The exact answer at the same points of the pixels: Lambert's cosine against the integral over the
    // sphere.
    static Image exact_effect(const Scene& scene, float radius_mm, const ComparisonSettings& settings) {
        const auto profile = find_profile(scene.skin.profile);
        const GaussianSum sum = to_gaussian_sum(*profile).sum;
        const Mat4 m = camera_matrices(scene.camera, 1).inverse_view_projection;
        const auto point = [&](float x, float y, float z) {
            const auto row = [&](int r) {
                return m.m[r] * x + m.m[4 + r] * y + m.m[8 + r] * z + m.m[12 + r];
            };
            return Vec3{row(0), row(1), row(2)} * (1 / row(3));
        };
        const Light& key = scene.key_light();
        const Vec3 albedo =
            scene.objects[0].mesh.materials[0].base_color_linear * scene.skin.albedo_tint_linear;
        const Vec3 scale = albedo * key.color_linear * (key.intensity / 3.14159265f);
        Image image(settings.width, settings.height, 3);
        const int fine = settings.width * settings.grid;
        for (int y = 0; y < fine; ++y)
            for (int x = 0; x < fine; ++x) {
                const float cx = 2 * (float(x) + 0.5f) / float(fine) - 1,
                            cy = 2 * (float(y) + 0.5f) / float(fine) - 1;
                const Vec3 o = point(cx, cy, 0), d = normalize(point(cx, cy, 1) - o),
                           to = o - scene.camera.target_mm;
                const float b = dot(to, d), q = b * b - dot(to, to) + radius_mm * radius_mm;
                if (q < 0) continue;
                const Vec3 n = normalize(to + d * (-b - std::sqrt(q)));
                const double t = dot(n, key.to_light_world);
                const Rgb value = preintegrated_diffuse(sum, t, radius_mm);
                float* out = &image.floats()[3 * (size_t(y / settings.grid) * size_t(settings.width) +
                                                  size_t(x / settings.grid))];
                const float part = 1 / float(settings.grid * settings.grid), flat = float(std::max(t, 0.0));
                const float s[3] = {scale.x, scale.y, scale.z};
                for (int c = 0; c < 3; ++c) out[c] += part * s[c] * (float(value[c]) - flat);
            }
        return image;
    }
};

}  // namespace

// The truth, the technique and the formula are three codes; any two of them have to agree.
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
    const Image exact = exact_effect(scene, kSphereRadiiMm[kSphere], settings);
    const auto formula = captured(exact, comparison->truth.effect, skin);
    ASSERT_TRUE(formula);
    EXPECT_GT(formula->all.share, 0.97) << "the formula against the truth";
    EXPECT_LT(formula->all.error, 0.03);
    EXPECT_EQ(comparison->rows[0].captured.all.share, 0);
    EXPECT_GT(comparison->rows[1].captured.all.share, 0.97) << "the technique against the truth";
    const auto table = captured(comparison->rows[1].effect, {exact, exact}, skin);
    ASSERT_TRUE(table);
    EXPECT_GT(table->all.share, 0.98) << "the technique against the formula";
}
