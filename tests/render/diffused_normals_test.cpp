// Normals averaged by the diffusion profile, over shapes with a known answer.

#include "dermis/render/diffused_normals.h"

#include <gtest/gtest.h>

#include "dermis/optics/preintegration.h"
#include "dermis/technique/diffused_normals.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

constexpr DiffusedNormalsRequest kRequest{.size = 256, .finest_variance_mm2 = 0.1f};

Scene unit_scene(const std::string& shape) {
    auto scene =
        load_scene("unit", {.subjects = built_in_catalog().subjects, .words = {{"mesh.shape", shape}}});
    EXPECT_TRUE(scene) << scene.error().message;
    return std::move(*scene);
}

Vec3 decoded(const DiffusedNormals::Texel& texel) {
    const auto part = [](uint16_t x) { return 2 * float(x) / 65535 - 1; };
    return {part(texel[0]), part(texel[1]), part(texel[2])};
}

struct Baked {
    SkinTexels skin;
    DiffusedNormals normals;
    Vec3 own_weight;

    // As a pixel mixes it that sees the texel.
    [[nodiscard]] Vec3 mean(const SkinTexel& texel, int channel) const {
        const float own = channel == 0 ? own_weight.x : channel == 1 ? own_weight.y : own_weight.z;
        const auto& stored = channel == 0 ? normals.red : normals.green;
        return texel.n * own + decoded(stored[texel.index]) * (1 - own);
    }
};

Baked bake(const Scene& scene, const GaussianSum& profile) {
    const auto reader = SkinTexelReader::create(scene);
    EXPECT_TRUE(reader);
    auto normals = bake_diffused_normals(scene, profile, kRequest);
    EXPECT_TRUE(normals) << normals.error().message;
    return {reader->read(kRequest.size), std::move(*normals), own_normal_weights(profile, kRequest)};
}

}  // namespace

// So that the table of a sphere, read at the mean's direction and at the curvature that its length says, is
// the same as without a map.
TEST(DiffusedNormals, of_a_sphere_are_its_normals_as_long_as_its_mean_cosine) {
    const Scene scene = unit_scene("sphere");
    float radius_mm = 0;
    for (const Vec3 p : scene.objects[0].mesh.positions_mm)
        radius_mm = std::max(radius_mm, length(p - scene.bounds_center_mm));
    const Baked baked = bake(scene, gpu_gems_3_skin());
    const Rgb expected = preintegrated_mean_cosine(gpu_gems_3_skin(), radius_mm);
    ASSERT_LT(expected[0], 0.95) << "too flat a sphere to tell";
    ASSERT_GT(baked.skin.texels.size(), 10000u);
    for (size_t i = 0; i < baked.skin.texels.size(); i += 61) {
        const SkinTexel& texel = baked.skin.texels[i];
        for (int c = 0; c < 3; ++c) {
            const Vec3 mean = baked.mean(texel, c);
            EXPECT_NEAR(length(mean), expected[size_t(c)], 0.003)
                << "texel " << texel.index << " channel " << c;
            EXPECT_GT(dot(normalize(mean), normalize(texel.n)), 0.9995) << "texel " << texel.index;
        }
    }
}

TEST(DiffusedNormals, of_a_plane_are_its_normal) {
    const Baked baked = bake(unit_scene("shadow_edge"), gpu_gems_3_skin());
    ASSERT_FALSE(baked.skin.texels.empty());
    for (size_t i = 0; i < baked.skin.texels.size(); i += 61)
        EXPECT_LT(length(baked.mean(baked.skin.texels[i], 0) - baked.skin.texels[i].n), 1e-3f);
}

// So that the spread on a sphere, to first order the mean squared distance, is the whole profile's.
TEST(DiffusedNormals, are_mixed_with_the_pixels_own_by_the_profiles_spread) {
    const Vec3 own = own_normal_weights(gpu_gems_3_skin(), kRequest);
    // Weights times variances in mm^2: of the Gaussians that are stored, and of all.
    const float stored_red = 1.3765f / 0.667f, stored_green = 0.0490f / 0.209f;
    EXPECT_NEAR(1 - own.x, 1.3829 / stored_red, 1e-3);
    EXPECT_NEAR(1 - own.y, 0.0681 / stored_green, 1e-3);
    EXPECT_NEAR(1 - own.z, 0.0248 / stored_green, 1e-3);
}
