// Files, materials and tone mapping through the whole renderer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dermis/image/colour.h"
#include "dermis/image/io.h"
#include "dermis/image/tone_map.h"
#include "dermis/render/frame_values.h"
#include "dermis/render/output.h"
#include "dermis/render/shared_passes.h"
#include "dermis/scene/image_source.h"
#include "render/render_test.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {
class Pictures : public RenderTest {};
}  // namespace

TEST_F(Pictures, the_shader_tone_maps_as_the_library_does) {
    Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("lambert");
    for (const ToneMap curve : {ToneMap::none, ToneMap::hable, ToneMap::aces, ToneMap::pbr_neutral}) {
        scene.tone_map = curve;
        const DrawSettings settings = {.width = 96, .height = 64, .deep = true};
        const Image linear = radiance(renderer, technique, settings);
        const Image display = *renderer.display();
        for (int y = 0; y < linear.height; ++y)
            for (int x = 0; x < linear.width; ++x) {
                const Vec3 c = {linear.at(x, y, 0), linear.at(x, y, 1), linear.at(x, y, 2)};
                const Vec3 expected = tone_map(curve, c * std::exp2(scene.exposure_ev));
                const float mapped[3] = {expected.x, expected.y, expected.z};
                for (int k = 0; k < 3; ++k)
                    ASSERT_NEAR(display.at(x, y, k), srgb_encode(std::min(mapped[k], 1.0f)), 2e-3f)
                        << int(curve) << " " << x << " " << y;
            }
    }
}

TEST_F(Pictures, an_exr_of_a_debug_view_holds_its_numbers) {
    const TemporaryDirectory directory;
    Scene scene = load("builtin:spheres");
    for (SceneObject& object : scene.objects) {
        object.mesh.materials[0].base_color_linear = {0.25f, 0.5f, 0.75f};
        object.mesh.materials[0].roughness = 0.375f;
    }
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("lambert");
    const ParameterValues values(technique.parameters);
    for (const std::string& view : gbuffer_views()) {
        const DrawSettings draw = {.width = 48, .height = 48, .view = view, .shadow_map_size = 64};
        ASSERT_TRUE(renderer.draw(technique, values, draw));
        const auto path = directory.path / (view + ".exr");
        ASSERT_TRUE(write_output(renderer, technique, values, draw, path, {})) << view;
        const Result<LoadedImage> read = read_image(path, ImageUse::data);
        ASSERT_TRUE(read) << read.error().message;
        const Image& image = read->image;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < image.channels; ++c)
                    ASSERT_TRUE(std::isfinite(image.at(x, y, c))) << view;
        float largest[3] = {};
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < std::min(image.channels, 3); ++c)
                    largest[c] = std::max(largest[c], image.at(x, y, c));
        if (view == "albedo") {
            EXPECT_NEAR(largest[0], 0.25f, 1e-3f);
            EXPECT_NEAR(largest[2], 0.75f, 1e-3f);
        }
        if (view == "roughness") {
            EXPECT_NEAR(largest[0], 0.375f, 1e-3f);
        }
        if (view == "normal") {
            EXPECT_GT(largest[2], 0.95f) << "towards the camera";
        }
        if (view == "depth") {
            EXPECT_GT(largest[0], 100) << "millimetres";
        }
    }
}

TEST_F(Pictures, png_and_exr_carry_the_credit) {
    const TemporaryDirectory directory;
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("lambert");
    const ParameterValues values(technique.parameters);
    const DrawSettings draw = {.width = 48, .height = 32, .shadow_map_size = 64};
    ASSERT_TRUE(renderer.draw(technique, values, draw));
    for (const char* name : {"a.png", "a.exr"}) {
        const auto path = directory.path / name;
        ASSERT_TRUE(write_output(renderer, technique, values, draw, path, {.credit = "by somebody"}));
        const Result<LoadedImage> read = read_image(path, ImageUse::color);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->image.width, 48);
        EXPECT_EQ(read->text.at("Copyright"), "by somebody");
    }
}

TEST_F(Pictures, a_layered_exr_holds_the_beauty_and_the_surface) {
    const TemporaryDirectory directory;
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("wrap");
    const ParameterValues values(technique.parameters);
    const DrawSettings draw = {.width = 48, .height = 32, .shadow_map_size = 64};
    ASSERT_TRUE(renderer.draw(technique, values, draw));
    const Image beauty = *renderer.radiance();
    const auto path = directory.path / "layers.exr";
    ASSERT_TRUE(write_output(renderer, technique, values, draw, path, {.layers = true}));
    const Result<LoadedImage> read = read_image(path, ImageUse::color);
    ASSERT_TRUE(read) << read.error().message;
    for (int x = 0; x < 48; ++x) EXPECT_EQ(read->image.at(x, 16, 0), beauty.at(x, 16, 0));
}

TEST_F(Pictures, a_missing_map_is_an_error_that_names_it) {
    Scene scene = load("builtin:spheres");
    scene.objects[0].mesh.materials[0].base_color_map.name = "/nowhere/skin.png";
    const auto renderer =
        Renderer::create(device(), gpu::embedded_shaders(built_in_catalog().shaders), scene);
    ASSERT_FALSE(renderer);
    EXPECT_THAT(renderer.error().message, testing::StartsWith("/nowhere/skin.png: "));
}

TEST(CheckOutput, refuses_what_cannot_be_written_before_anything_runs) {
    EXPECT_EQ(check_output("a.jpg", {}).error().message, "a.jpg: a picture is a .png or an .exr file");
    EXPECT_EQ(check_output("a.png", {.layers = true}).error().message, "a.png: --layers needs an .exr file");
    EXPECT_EQ(check_output("a.png", {.png_bits = 12}).error().message, "--bits 12: 8 or 16");
    EXPECT_TRUE(check_output("out/A.EXR", {.layers = true}));
}

TEST(LightMatrix, holds_the_bounding_sphere_tightly) {
    const Vec3 center = {10, -20, 30};
    for (const LightKind kind : {LightKind::directional, LightKind::point}) {
        const Light light = {.kind = kind,
                             .to_light_world = normalize(Vec3{1, 2, 3}),
                             .position_mm = center + normalize(Vec3{1, 2, 3}) * 500.0f};
        const Mat4 m = light_matrix(light, center, 100);
        float largest = 0;
        for (int i = 0; i < 4000; ++i) {
            const float z = 1 - 2 * (float(i) + 0.5f) / 4000, angle = 2.399963f * float(i),
                        r = std::sqrt(1 - z * z);
            const Vec3 p = center + Vec3{r * std::cos(angle), r * std::sin(angle), z} * 100.0f;
            const auto row = [&](int k) {
                return m.m[k] * p.x + m.m[4 + k] * p.y + m.m[8 + k] * p.z + m.m[12 + k];
            };
            const float w = row(3);
            EXPECT_LE(std::max(std::abs(row(0) / w), std::abs(row(1) / w)), 1.001f);
            EXPECT_GE(row(2) / w, -1e-3f);
            EXPECT_LE(row(2) / w, 1.001f);
            largest = std::max({largest, std::abs(row(0) / w), std::abs(row(1) / w)});
        }
        EXPECT_GT(largest, 0.99f) << "texels are wasted";
    }
}

TEST(AtlasMask, covers_a_triangle_whatever_its_winding) {
    Mesh mesh;
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
    for (const std::vector<uint32_t>& winding : {std::vector<uint32_t>{0, 1, 2}, {0, 2, 1}}) {
        mesh.indices = winding;
        const Image mask = atlas_mask(mesh, 8, 8);
        EXPECT_EQ(mask.at(0, 0, 0), 1);
        EXPECT_EQ(mask.at(7, 7, 0), 0);
        int covered = 0;
        for (const std::byte value : mask.bytes) covered += value != std::byte{0};
        EXPECT_NEAR(covered, 32, 4);
    }
}
