// Normals averaged by the diffusion profile, over shapes with a known answer.

#include "dermis/render/seam_textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "dermis/optics/diffused_normals.h"
#include "dermis/optics/preintegration.h"
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

// Two halves of an atlas: on the left one normal, on the right two that alternate from texel to texel; below
// no skin.
DiffusedNormals made_normals(int size, Vec3 left, Vec3 right_a, Vec3 right_b) {
    DiffusedNormals normals{.size = size, .red = {}, .green = {}};
    const auto part = [](float x) { return uint16_t(std::lround((0.5f * x + 0.5f) * 65535)); };
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const Vec3 n = y >= size / 2 ? Vec3{} : x < size / 2 ? left : (x + y) % 2 ? right_a : right_b;
            normals.red.push_back({part(n.x), part(n.y), part(n.z), part(0.5f)});
            normals.green.push_back({part(n.x), part(n.y + 0.1f), part(n.z), part(-0.25f)});
        }
    return normals;
}

struct Decoded {
    Vec3 red, green;
    float length;
};

// Texel of a level, as the shader reads it.
Decoded decoded(const std::vector<gpu::TextureData>& textures, int level, int x, int y) {
    size_t before = 0;
    for (int i = 0; i < level; ++i) before += size_t(textures[0].width >> i) * size_t(textures[0].width >> i);
    const size_t at = 4 * (before + size_t(y) * size_t(textures[0].width >> level) + size_t(x));
    uint32_t packed;
    std::memcpy(&packed, &textures[0].bytes[at], 4);
    const auto ten = [&](int shift) { return 2 * float(packed >> shift & 1023) / 1023 - 1; };
    const auto byte = [&](size_t c) { return float(std::to_integer<int>(textures[1].bytes[at + c])); };
    const auto apart = [&](size_t c) {
        const float root = (byte(c) - 128) / 127;
        return root * std::abs(root);
    };
    Decoded made{.red = {ten(0), ten(10), ten(20)}, .green = {}, .length = 1 - byte(3) * byte(3) / 65025};
    if (length(made.red) > 0.5f) made.red = normalize(made.red);
    made.green = normalize(made.red + Vec3{apart(0), apart(1), apart(2)});
    return made;
}

}  // namespace

TEST(DiffusedNormalsTextures, keep_direction_and_length_within_the_stated_errors) {
    const Vec3 left = normalize(Vec3{0.3f, -0.2f, 0.9f}) * 0.9995f;  // the length of a head's cheek
    const auto textures = diffused_normals_textures(made_normals(8, left, left, left));
    ASSERT_EQ(textures.size(), 3u);
    const Decoded texel = decoded(textures, 0, 1, 1);
    EXPECT_LT(length(texel.red - normalize(left)), 0.0015f);
    EXPECT_LT(length(texel.green - normalize(left + Vec3{0, 0.1f, 0})), 0.004f);
    EXPECT_NEAR(texel.length, 0.9995f, 1e-4f);
    EXPECT_LT(length(decoded(textures, 0, 1, 7).red), 0.01f) << "no skin";
}

TEST(DiffusedNormalsTextures, levels_are_means_of_the_skin_in_them_and_shorter_where_bumps_are) {
    const Vec3 left{0, 0, 1}, a = normalize(Vec3{0.5f, 0, 1}), b = normalize(Vec3{-0.5f, 0, 1});
    const auto textures = diffused_normals_textures(made_normals(8, left, a, b));
    EXPECT_EQ(textures[0].mips, 4);
    EXPECT_NEAR(decoded(textures, 1, 0, 0).length, 1, 1e-4f);
    EXPECT_NEAR(decoded(textures, 1, 2, 0).length, a.z, 0.004f);
    // The last level but one: a texel is half bumps, and half of the last lies beside the skin.
    EXPECT_NEAR(decoded(textures, 3, 0, 0).length, 0.5f * (1 + a.z), 0.004f);
    EXPECT_LT(length(decoded(textures, 2, 0, 1).red), 0.01f);
}

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
