// Physical properties that every technique must have.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dermis/image/io.h"
#include "dermis/scene/brdf_table.h"
#include "render/furnace.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

const DrawSettings kSmall = {.width = 128, .height = 128, .shadow_map_size = 512};

class Properties : public RenderTest {};

void scale_lengths(Scene& scene, float factor) {
    for (SceneObject& object : scene.objects) {
        for (Vec3& p : object.mesh.positions_mm) p *= factor;
        for (CurvatureTensor& curvature : object.mesh.curvatures_per_mm) {
            curvature.diagonal *= 1 / factor;
            curvature.mixed *= 1 / factor;
        }
    }
    scene.camera.eye_mm *= factor;
    scene.camera.target_mm *= factor;
    scene.camera.near_mm *= factor;
    scene.camera.far_mm *= factor;
    scene.bounds_center_mm *= factor;
    scene.bounds_radius_mm *= factor;
}

// Only directional light: no environment, no specular, no point lights.
Scene key_light_only(Scene scene) {
    std::erase_if(scene.lights, [](const Light& light) { return !light.is_key; });
    scene.environment.kind = EnvironmentKind::none;
    scene.background_linear = {};
    return scene;
}

}  // namespace

TEST_F(Properties, every_technique_is_linear_in_light) {
    Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    scene.background_linear = {};
    for (const Technique& technique : built_in_catalog().techniques) {
        const Image once = radiance(renderer, technique, kSmall);
        for (Light& light : scene.lights) light.intensity *= 2;
        scene.environment.intensity *= 2;
        const Image twice = radiance(renderer, technique, kSmall);
        for (Light& light : scene.lights) light.intensity /= 2;
        scene.environment.intensity /= 2;
        EXPECT_LT(relative_difference(once, twice, 2), 4e-3) << technique.id;
    }
}

TEST_F(Properties, every_technique_draws_the_same_frame_twice) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques) {
        const Image first = radiance(renderer, technique, kSmall),
                    second = radiance(renderer, technique, kSmall);
        EXPECT_EQ(first.bytes, second.bytes) << technique.id;
    }
}

TEST_F(Properties, baselines_do_not_depend_on_the_scale) {
    Scene scene = key_light_only(load("builtin:spheres")), large = scene;
    scale_lengths(large, 10);
    Renderer renderer = make_renderer(scene), large_renderer = make_renderer(large);
    DrawSettings large_settings = kSmall;
    large_settings.penumbra_mm = kSmall.penumbra_mm * 10;
    for (const char* id : {"lambert", "oren_nayar"}) {
        const Technique& technique = built_in_technique(id);
        const Image a = radiance(renderer, technique, kSmall),
                    b = radiance(large_renderer, technique, large_settings);
        // Half floats and shadow edges: a few pixels may fall on the other side of a comparison.
        EXPECT_LT(relative_difference(a, b, 1), 0.06) << id;
    }
}

TEST_F(Properties, without_a_specular_model_nothing_is_reflected) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    DrawSettings settings = kSmall;
    settings.view = "specular";
    for (const Technique& technique : built_in_catalog().techniques) {
        ParameterValues values = small_map_values(technique);
        if (!values.set("specular", "none")) continue;
        const Image image = radiance(renderer, technique, values, settings);
        EXPECT_EQ(largest_value(image), 0) << technique.id;
    }
}

TEST_F(Properties, no_technique_adds_energy_in_a_white_furnace) {
    // The diffuse light of a white sphere under an environment of constant radiance is 1, with any
    // profile. A gain may return up to 1 / albedo of its medium (gain_test.cpp).
    const TemporaryDirectory directory;
    const Scene scene = sphere_in_furnace(load("builtin:spheres"), directory, 1);
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques) {
        DrawSettings diffuse = kSmall;
        diffuse.view = "diffuse";
        const Image image = radiance(renderer, technique, profile_values(technique), diffuse);
        const Image ones = [&] {
            Image filled = image;
            std::ranges::fill(filled.floats(), 1.0f);
            return filled;
        }();
        // Oren and Nayar's model loses light that facets send to one another; its own test has the amount.
        if (technique.id != "oren_nayar") {
            EXPECT_LT(relative_difference(image, ones, 1), 0.02) << technique.id;
        }
        EXPECT_LT(largest_value(image), 1.02) << technique.id;
    }
}

// The diffuse light is not reduced by what is reflected: an albedo of fair skin leaves room for both.
TEST_F(Properties, skin_and_its_reflection_return_less_light_than_arrives) {
    const TemporaryDirectory directory;
    const Scene scene = sphere_in_furnace(load("builtin:spheres"), directory, 0.75f);
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques) {
        const Image image = radiance(renderer, technique, profile_values(technique), kSmall);
        double sum = 0;
        int count = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                if (image.at(x, y, 3) == 1) sum += image.at(x, y, 0), ++count;
        EXPECT_LT(largest_value(image), 1) << technique.id;
        if (technique.id != "oren_nayar") {
            EXPECT_NEAR(sum / count, 0.75 + 0.047, 0.002) << technique.id;
        }
    }
}

TEST_F(Properties, the_vertices_occlusion_and_the_maps_are_counted_once) {
    Scene scene = evenly_lit_spheres();
    DrawSettings diffuse = kSmall;
    diffuse.view = "diffuse";
    const auto lit = [&](float at_vertices, int in_map) {
        for (SceneObject& object : scene.objects) {
            object.mesh.occlusions.assign(object.mesh.positions_mm.size(), at_vertices);
            object.mesh.materials[0].occlusion_map = {.name = "occlusion " + std::to_string(in_map),
                                                      .width = 1,
                                                      .height = 1,
                                                      .channels = 1,
                                                      .pixels = {std::byte(in_map)}};
        }
        Renderer renderer = make_renderer(scene);
        return largest_value(radiance(renderer, built_in_technique("lambert"), diffuse));
    };
    const float whole = lit(1, 255);
    EXPECT_NEAR(lit(0.5f, 255) / whole, 0.5f, 2e-3f);
    EXPECT_NEAR(lit(0.5f, 128) / whole, 0.5f, 2e-3f);
    EXPECT_NEAR(lit(0.5f, 64) / whole, 64 / 255.0f, 2e-3f);
}

TEST_F(Properties, reflections_of_a_white_furnace_are_the_split_sum) {
    const TemporaryDirectory directory;
    Scene scene = sphere_in_furnace(load("builtin:spheres"), directory, 1);
    Material& skin = scene.objects[0].mesh.materials[0];
    skin.ior = 1.5f;
    skin.roughness = 0.3f;
    Renderer renderer = make_renderer(scene);
    DrawSettings settings = kSmall;
    settings.view = "specular";
    settings.deep = settings.gbuffer = true;
    const Image image = radiance(renderer, built_in_technique("lambert"), settings);
    const Image normal = *renderer.read("gbuffer_geometry"), position = *renderer.read("gbuffer_position");
    size_t compared = 0;
    for (int y = 0; y < image.height; y += 5)
        for (int x = 0; x < image.width; x += 5) {
            if (image.at(x, y, 3) == 0) continue;
            const Vec3 n = {normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2)};
            const Vec3 p_mm = {position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2)};
            const float n_dot_v = dot(n, normalize(scene.camera.eye_mm - p_mm));
            if (n_dot_v < 0.1f) continue;
            const Vec2 exact = ggx_scale_and_bias(0.3f, n_dot_v);
            EXPECT_NEAR(image.at(x, y, 1), 0.04f * exact.x + exact.y, 0.003f) << "n.v " << n_dot_v;
            ++compared;
        }
    EXPECT_GT(compared, 50u);
}

TEST_F(Properties, lambert_on_a_sphere_is_the_clamped_cosine) {
    const Scene scene = key_light_only([] {
        Scene loaded = load("builtin:spheres");
        for (SceneObject& object : loaded.objects)
            for (Material& material : object.mesh.materials) material.specular = 0;
        return loaded;
    }());
    Renderer renderer = make_renderer(scene);
    DrawSettings settings = kSmall;
    settings.gbuffer = true;
    const Image image = radiance(renderer, built_in_technique("lambert"), settings);
    const Image normal = *renderer.read("gbuffer_geometry"), albedo = *renderer.read("gbuffer_albedo");
    const Image light = *renderer.read("gbuffer_light");
    const Light& key = scene.key_light();
    size_t compared = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (image.at(x, y, 3) == 0 || light.at(x, y, 3) < 1) continue;
            const Vec3 n = {normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2)};
            const float cosine = std::max(0.0f, dot(n, key.to_light_world));
            for (int c = 0; c < 3; ++c) {
                const float color = c == 0   ? key.color_linear.x
                                    : c == 1 ? key.color_linear.y
                                             : key.color_linear.z;
                const float expected = albedo.at(x, y, c) * color * key.intensity * cosine / 3.14159265f;
                EXPECT_NEAR(image.at(x, y, c), expected, 2e-3f + 2e-3f * expected);
            }
            ++compared;
        }
    EXPECT_GT(compared, 1000u);
}

TEST_F(Properties, four_samples_a_pixel_change_edges_only) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques) {
        const DrawSettings rough = {.width = 64, .height = 64, .shadow_map_size = 512};
        DrawSettings smooth = rough;
        smooth.samples = 4;
        const Image one = radiance(renderer, technique, rough), four = radiance(renderer, technique, smooth);
        size_t inside = 0, far_off = 0;
        for (int y = 0; y < one.height; ++y)
            for (int x = 0; x < one.width; ++x) {
                if (one.at(x, y, 3) < 1 || four.at(x, y, 3) < 1) continue;
                ++inside;
                far_off += std::abs(one.at(x, y, 0) - four.at(x, y, 0)) > 0.05f;
            }
        EXPECT_GT(inside, 250u);
        EXPECT_LT(far_off, inside / 50) << technique.id;
    }
}

TEST_F(Properties, every_view_of_every_technique_can_be_drawn) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques)
        for (const std::string& view : view_names(technique)) {
            DrawSettings settings = {.width = 32, .height = 32, .view = view, .shadow_map_size = 64};
            const auto drawn = renderer.draw(technique, small_map_values(technique), settings);
            EXPECT_TRUE(drawn) << technique.id << " " << view << ": " << drawn.error().message;
            EXPECT_TRUE(renderer.display()) << technique.id << " " << view;
        }
}
