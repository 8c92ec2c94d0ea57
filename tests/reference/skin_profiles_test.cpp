// Profiles of materials and weights of scattering in both references.

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/reference/picture.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

// Two balls of skin, apart; only the left one's material is changed.
Scene two_balls(const std::string& left_profile, float left_scatter) {
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        SceneObject ball{.name = "ball", .mesh = test::sphere(10, 4), .classes = {MaterialClass::skin}};
        for (Vec3& p : ball.mesh.positions_mm) p.x += i == 0 ? -15.0f : 15.0f;
        if (i == 0) {
            ball.mesh.materials[0].profile = left_profile;
            ball.mesh.materials[0].scatter = left_scatter;
        }
        scene.objects.push_back(std::move(ball));
    }
    scene.lights.push_back(
        {.intensity = 3, .to_light_world = normalize(Vec3{0.2f, 1, 0.4f}), .is_key = true});
    scene.camera = {.eye_mm = {0, 0, 200}, .vertical_fov_rad = 0.3f, .near_mm = 1, .far_mm = 500};
    scene.environment.kind = EnvironmentKind::none;
    scene.skin.profile = "gpu_gems_3";
    return scene;
}

Image picture(const Scene& scene, Integrator integrator, double width_scale = 1) {
    ReferenceSettings settings{
        .integrator = integrator, .width = 32, .height = 32, .samples = 4, .probes = 8};
    settings.width_scale = width_scale;
    settings.lighting.specular = SpecularReflection::none;
    const Result<ReferencePicture> made = render_reference(scene, settings);
    EXPECT_TRUE(made) << made.error().message;
    return made ? made->radiance : Image(32, 32, 4);
}

double difference(const Image& a, const Image& b, int begin, int end) {
    double sum = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = begin; x < end; ++x)
            for (int c = 0; c < 3; ++c) sum += std::abs(double(a.at(x, y, c) - b.at(x, y, c)));
    return sum;
}

class SkinProfilesOfReference : public testing::TestWithParam<Integrator> {};

TEST_P(SkinProfilesOfReference, each_ball_is_as_with_its_profile_alone) {
    const Image both = picture(two_balls("openpbr_skin_6", 1), GetParam());
    const Image wide = picture(two_balls("", 1), GetParam());
    Scene all = two_balls("openpbr_skin_6", 1);
    all.skin.profile = "openpbr_skin_6";
    const Image narrow = picture(all, GetParam());
    EXPECT_GT(difference(wide, narrow, 0, 32), 0.1);
    EXPECT_EQ(difference(both, wide, 16, 32), 0);
    EXPECT_EQ(difference(both, narrow, 0, 16), 0);
}

TEST_P(SkinProfilesOfReference, skin_of_no_scatter_is_lambert) {
    const Image none = picture(two_balls("", 0), GetParam()), full = picture(two_balls("", 1), GetParam());
    const Image lambert = picture(two_balls("", 1), GetParam(), 0);
    EXPECT_EQ(difference(none, lambert, 0, 16), 0);
    EXPECT_EQ(difference(none, full, 16, 32), 0);
    EXPECT_GT(difference(none, full, 0, 16), 0.1);
    const Image quarter = picture(two_balls("", 0.25f), GetParam());
    double error = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < 3; ++c)
                error = std::max(error, std::abs(double(quarter.at(x, y, c) - 0.75f * none.at(x, y, c) -
                                                        0.25f * full.at(x, y, c))));
    EXPECT_LT(error, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(both, SkinProfilesOfReference,
                         testing::Values(Integrator::surface, Integrator::walk));

}  // namespace
}  // namespace dermis
