// The gain of curved skin in pictures.

#include "dermis/technique/gain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/mesh/primitives.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/curvature_gain.h"
#include "dermis/rays/vertex_gain.h"
#include "dermis/scene/placement.h"
#include "render/render_test.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

const DrawSettings kDraw = {
    .width = 96, .height = 96, .view = "diffuse", .gbuffer = true, .deep = true, .shadow_map_size = 512};

// Light through thin parts has a gain of its own.
void without_transmission(const Technique& technique, ParameterValues& values) {
    if (technique.parameters.find("transmission")) ASSERT_TRUE(values.set("transmission", "none"));
}

using Gains = RenderTest;

Scene ball_lit_from_behind(float radius_mm) {
    Scene scene;
    scene.objects.push_back(
        {.name = "ball", .mesh = make_sphere(radius_mm, 32), .classes = {MaterialClass::skin}});
    place_in_studio(scene);
    EXPECT_TRUE(complete_scene(scene));
    Light light = scene.lights.front();
    light.to_light_world = {0, 0, -1};
    light.is_key = true;
    scene.lights = {light};
    scene.environment = {.kind = EnvironmentKind::none};
    scene.skin.profile = "openpbr_skin_3";
    return scene;
}

// Of the gain that a picture shows, from the closed form by the curvature.
double rms_off_the_form(Renderer& renderer, const Image& with, const Image& without, const GainForm& form) {
    const Result<Image> normal = renderer.read("gbuffer_normal");
    EXPECT_TRUE(normal) << normal.error().message;
    const Image per_mm = to_linear_float(*normal);  // in alpha
    double squares = 0;
    int count = 0;
    for (int y = 0; y < with.height; ++y)
        for (int x = 0; x < with.width; ++x)
            for (int c = 0; c < 3; ++c) {
                if (without.at(x, y, c) < 0.01f) continue;
                const double off = with.at(x, y, c) / without.at(x, y, c) - gain(form, c, per_mm.at(x, y, 3));
                squares += off * off;
                ++count;
            }
    return std::sqrt(squares / count);
}

// Even light, because texture_space_gaussians takes the light of the gain from farther away than the
// profile's.
TEST_F(Gains, multiply_even_light_of_every_technique_that_scatters_by_the_form_of_the_curvature) {
    const Scene scene = evenly_lit_spheres();
    const GainForm form = walked_gain_form(walk_medium_of(*find_profile(scene.skin.profile)));
    Renderer renderer = make_renderer(scene);
    int techniques = 0;
    for (const Technique& technique : built_in_catalog().techniques) {
        ParameterValues values = small_map_values(technique);
        if (!technique.parameters.find("gain")) continue;
        without_transmission(technique, values);
        ++techniques;
        ASSERT_TRUE(values.set("gain", "none"));
        const Image without = radiance(renderer, technique, values, kDraw);
        ASSERT_TRUE(values.set("gain", "curvature"));
        const Image with = radiance(renderer, technique, values, kDraw);
        const Result<Image> normal = renderer.read("gbuffer_normal");
        ASSERT_TRUE(normal) << normal.error().message;
        const Image per_mm = to_linear_float(*normal);  // in alpha
        double worst = 0, largest = 1;
        for (int y = 0; y < with.height; ++y)
            for (int x = 0; x < with.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    if (without.at(x, y, c) < 0.01f) continue;
                    const double wanted = gain(form, c, per_mm.at(x, y, 3));
                    worst = std::max(worst, std::abs(with.at(x, y, c) / without.at(x, y, c) / wanted - 1));
                    largest = std::max(largest, wanted);
                }
        EXPECT_LT(worst, 0.01) << technique.id;
        EXPECT_GT(largest, 1.2) << "the spheres are too flat to tell";
    }
    EXPECT_EQ(techniques, 7);
}

TEST_F(Gains, of_the_map_are_those_of_walks_in_every_technique) {
    const Scene scene = evenly_lit_spheres();
    const ScatteringMedium medium = walk_medium_of(*find_profile(scene.skin.profile));
    const Result<VertexGains> walked = walk_vertex_gains(scene.objects, medium);
    ASSERT_TRUE(walked) << walked.error().message;
    const GainForm form = walked_gain_form(medium);
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques) {
        ParameterValues values = small_map_values(technique);
        if (!technique.parameters.find("gain")) continue;
        without_transmission(technique, values);
        ASSERT_TRUE(values.set("gain", "none"));
        const Image without = radiance(renderer, technique, values, kDraw);
        ASSERT_TRUE(values.set("gain", "map"));
        const Image with = radiance(renderer, technique, values, kDraw);
        // The form is off walks by a few percent; without the map the gain of spheres is off by tenths.
        const double rms = rms_off_the_form(renderer, with, without, form);
        EXPECT_LT(rms, 0.04) << technique.id;
        EXPECT_GT(rms, 1e-4) << technique.id << ": the form itself is drawn";
    }
    float most = 0;
    for (const std::vector<Vec3>& gains : walked->gains)
        for (const Vec3& value : gains) most = std::max(most, value.x);
    EXPECT_GT(most, 1.2f) << "the spheres are too flat to tell";
}

TEST_F(Gains, of_links_under_even_light_are_those_of_walks_in_every_technique) {
    Scene scene = evenly_lit_spheres();
    scene.objects.resize(2);  // the smallest
    const GainForm form = walked_gain_form(walk_medium_of(*find_profile(scene.skin.profile)));
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques) {
        ParameterValues values = small_map_values(technique);
        if (!technique.parameters.find("gain")) continue;
        ASSERT_TRUE(values.set("gain", "none"));
        without_transmission(technique, values);
        const Image without = radiance(renderer, technique, values, kDraw);
        ASSERT_TRUE(values.set("gain", "links"));
        // Links replace it.
        if (technique.parameters.find("transmission")) ASSERT_TRUE(values.set("transmission", "shadow_map"));
        const Image with = radiance(renderer, technique, values, kDraw);
        const double rms = rms_off_the_form(renderer, with, without, form);
        EXPECT_LT(rms, 0.05) << technique.id;
        EXPECT_GT(rms, 1e-4) << technique.id << ": the form itself is drawn";
    }
}

// Behind an edge of light the light comes from where it is lit: no gain of a place can have it.
TEST_F(Gains, of_links_light_the_dark_side_of_a_small_ball) {
    const Scene scene = ball_lit_from_behind(2);
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("preintegrated");
    const auto brightness = [&](const char* gain) {
        ParameterValues values = small_map_values(technique);
        EXPECT_TRUE(values.set("gain", gain));
        EXPECT_TRUE(values.set("transmission", "none"));
        const Image drawn = radiance(renderer, technique, values, kDraw);
        return drawn.at(kDraw.width / 2, kDraw.height / 2, 0);
    };
    const float dark = brightness("map"), linked = brightness("links");
    EXPECT_LT(dark, 0.01f);
    EXPECT_GT(linked, 0.03f);
    EXPECT_EQ(brightness("map"), dark) << "the gains are those of links still";
}

TEST_F(Gains, of_links_of_more_vertices_than_a_dispatch_has_are_refused_before_walks) {
    Scene scene = ball_lit_from_behind(2);
    Mesh& mesh = scene.objects[0].mesh;
    mesh.positions_mm.resize(524'281);
    const Result<void> checked = LinkedLight::check(scene);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().message,
              "gain=links: ball has 524281 vertices, more than 524280; set gain=map or reduce the mesh");
    mesh.positions_mm.resize(524'280);
    EXPECT_TRUE(LinkedLight::check(scene));
}

}  // namespace
