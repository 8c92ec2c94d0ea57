// A plane under tinted translucent surfaces, lit from above: what arrives in the light map is known exactly.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/mesh/primitives.h"
#include "dermis/scene/placement.h"
#include "render/render_test.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

constexpr float kIrradiance = 2;
constexpr Vec3 kGlassTint = {0.2f, 0.5f, 0.9f};

SceneObject sheet(Vec3 color_linear, float height_mm, MaterialClass material_class) {
    // Over the half of the plane where x > 0.
    SceneObject object{.name = "sheet", .mesh = make_plane(60, 120), .classes = {material_class}};
    for (Vec3& p : object.mesh.positions_mm) p = p + Vec3{35, 0, height_mm};
    object.mesh.materials[0].base_color_linear = color_linear;
    object.mesh.materials[0].opacity = material_class == MaterialClass::translucent ? 0.0f : 1.0f;
    object.mesh.materials[0].specular = 0;
    return object;
}

Scene plane_under(std::vector<SceneObject> sheets) {
    Scene scene;
    scene.objects.push_back(
        {.name = "skin", .mesh = make_plane(100, 100, 8), .classes = {MaterialClass::skin}});
    for (SceneObject& object : sheets) scene.objects.push_back(std::move(object));
    place_in_studio(scene);
    scene.environment.kind = EnvironmentKind::none;
    scene.lights = {{.name = "key", .intensity = kIrradiance, .to_light_world = {0, 0, 1}, .is_key = true}};
    EXPECT_TRUE(complete_scene(scene));
    return scene;
}

class TranslucentShadow : public RenderTest {
  protected:
    using Settings = std::vector<std::pair<const char*, const char*>>;

    /// The light map of one frame, unblurred.
    static Image light_map(Renderer& renderer, const Settings& settings) {
        ParameterValues values(built_in_technique("texture_space").parameters);
        EXPECT_TRUE(values.set("blur_passes", "0") && values.set("light_map_size", "64"));
        for (const auto& [name, text] : settings) EXPECT_TRUE(values.set(name, text)) << name;
        const auto drawn = renderer.draw(built_in_technique("texture_space"), values,
                                         {.width = 64, .height = 64, .shadow_map_size = 512});
        EXPECT_TRUE(drawn) << drawn.error().message;
        return to_linear_float(*renderer.read("light_map_a"));
    }
    static Vec3 at(const Image& image, int x, int y) {
        return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
    }
    static void expect_near(Vec3 value, Vec3 expected) {
        EXPECT_NEAR(value.x, expected.x, 4e-3f);
        EXPECT_NEAR(value.y, expected.y, 4e-3f);
        EXPECT_NEAR(value.z, expected.z, 4e-3f);
    }
};

}  // namespace

TEST_F(TranslucentShadow, is_the_tint_to_the_given_power_between_occluded_and_white) {
    const Scene scene = plane_under({sheet(kGlassTint, 20, MaterialClass::translucent)});
    Renderer renderer = make_renderer(scene);
    for (const char* shadows : {"filtered", "source"}) {
        const Image plain = light_map(renderer, {{"shadows", shadows}});
        expect_near(at(plain, 12, 32), Vec3{1, 1, 1} * kIrradiance);
        expect_near(at(plain, 48, 32), kGlassTint * kIrradiance);
        const Image dark =
            light_map(renderer, {{"shadows", shadows}, {"trans_shadow_alpha", "2"}, {"occluded", "0.25"}});
        expect_near(at(dark, 48, 32),
                    (kGlassTint * kGlassTint * 0.75f + Vec3{1, 1, 1} * 0.25f) * kIrradiance);
        const Image off = light_map(renderer, {{"shadows", shadows}, {"trans_shadow_alpha", "0"}});
        expect_near(at(off, 48, 32), Vec3{1, 1, 1} * kIrradiance);
    }
}

TEST_F(TranslucentShadow, of_two_surfaces_is_the_product_of_their_tints) {
    const Scene scene = plane_under({sheet(kGlassTint, 20, MaterialClass::translucent),
                                     sheet({0.5f, 0.5f, 0.5f}, 30, MaterialClass::translucent)});
    Renderer renderer = make_renderer(scene);
    expect_near(at(light_map(renderer, {}), 48, 32), kGlassTint * 0.5f * kIrradiance);
}

// Gosselin, Sander, Mitchell 2004 add opacities: two sheets that pass .9 and .5 of blue pass 1 - .1 - .5.
TEST_F(TranslucentShadow, of_two_surfaces_adds_their_opacities_as_the_source_does) {
    const Scene scene = plane_under({sheet(kGlassTint, 20, MaterialClass::translucent),
                                     sheet({0.5f, 0.5f, 0.5f}, 30, MaterialClass::translucent)});
    Renderer renderer = make_renderer(scene);
    expect_near(at(light_map(renderer, {{"shadows", "source"}}), 48, 32), Vec3{0, 0, 0.4f} * kIrradiance);
}

// Radiance over albedo is E / pi.
TEST_F(TranslucentShadow, light_is_saturated_in_each_channel_with_the_sources_lookup_only) {
    Scene scene = plane_under({});
    scene.lights[0].color_linear = {3, 1, 0.25f};
    Renderer renderer = make_renderer(scene);
    const Vec3 irradiance = Vec3{3, 1, 0.25f} * kIrradiance;
    expect_near(at(light_map(renderer, {}), 12, 32), irradiance);
    expect_near(at(light_map(renderer, {{"shadows", "source"}}), 12, 32),
                {std::numbers::pi_v<float>, irradiance.y, irradiance.z});
}

TEST_F(TranslucentShadow, occluded_is_what_is_left_of_the_key_light_alone) {
    Scene scene = plane_under({sheet({1, 1, 1}, 20, MaterialClass::other)});
    Light second = scene.lights[0];
    second.name = "second", second.is_key = false;
    scene.lights.push_back(second);
    Renderer renderer = make_renderer(scene);
    const Image shaded = light_map(renderer, {{"occluded", "0.25"}});
    expect_near(at(shaded, 12, 32), Vec3{1, 1, 1} * (2 * kIrradiance));
    expect_near(at(shaded, 48, 32), Vec3{1, 1, 1} * (0.25f * kIrradiance));
}

TEST_F(TranslucentShadow, takes_one_channel_when_asked) {
    const Scene scene = plane_under({sheet(kGlassTint, 20, MaterialClass::translucent)});
    Renderer renderer = make_renderer(scene);
    expect_near(at(light_map(renderer, {{"shadows", "one_channel"}}), 48, 32),
                Vec3{1, 1, 1} * (kGlassTint.x * kIrradiance));
}

TEST_F(TranslucentShadow, reads_the_colours_of_an_opacity_map) {
    SceneObject lens = sheet({0, 0, 0}, 20, MaterialClass::translucent);
    lens.mesh.materials[0].opacity_map = {.name = "opacity of the test",
                                          .width = 1,
                                          .height = 1,
                                          .channels = 3,
                                          .pixels = {std::byte{255}, std::byte{188}, std::byte{0}}};
    const Scene scene = plane_under({lens});
    Renderer renderer = make_renderer(scene);
    expect_near(at(light_map(renderer, {}), 48, 32), Vec3{1, 0.503f, 0} * kIrradiance);
}

TEST_F(TranslucentShadow, leaves_the_depth_in_alpha_and_ignores_surfaces_behind_opaque_ones) {
    const Scene bare = plane_under(
        {sheet(kGlassTint, 20, MaterialClass::other), sheet(kGlassTint, 40, MaterialClass::other)});
    const Scene tinted = plane_under(
        {sheet(kGlassTint, 20, MaterialClass::translucent), sheet(kGlassTint, 40, MaterialClass::other)});
    Renderer without = make_renderer(bare), with = make_renderer(tinted);
    // The upper sheet is opaque: where it is, the lower one is hidden from the light.
    const Image dark = light_map(with, {});
    expect_near(at(dark, 48, 32), {});
    const Image channels = to_linear_float(*with.read("shadow_channels"));
    (void)light_map(without, {{"shadows", "source"}});
    const Image depth_only = to_linear_float(*without.read("shadow_channels"));
    for (int y = 0; y < channels.height; ++y)
        for (int x = 0; x < channels.width; ++x) {
            ASSERT_EQ(channels.at(x, y, 0), 0) << "tint behind an opaque surface, or beside it";
            ASSERT_EQ(channels.at(x, y, 3), depth_only.at(x, y, 3)) << x << " " << y;
        }
}

TEST_F(TranslucentShadow, does_not_write_depth) {
    const Scene tinted = plane_under({sheet(kGlassTint, 20, MaterialClass::translucent)});
    Renderer renderer = make_renderer(tinted);
    (void)light_map(renderer, {});
    const Image channels = to_linear_float(*renderer.read("shadow_channels"));
    float nearest = 1, thickest = 0;
    for (int y = 0; y < channels.height; ++y)
        for (int x = 0; x < channels.width; ++x) {
            nearest = std::min(nearest, channels.at(x, y, 3));
            thickest = std::max(thickest, channels.at(x, y, 0));
        }
    EXPECT_NEAR(thickest, -std::log(kGlassTint.x), 2e-3f);
    // The plane, in the light's range of two bounding radii around the middle of the scene.
    const float plane = 0.5f + tinted.bounds_center_mm.z / (2 * tinted.bounds_radius_mm);
    EXPECT_NEAR(nearest, plane, 2e-3f);
}

TEST_F(TranslucentShadow, of_a_second_light_lies_in_the_channels_that_one_light_leaves_free) {
    Scene scene = plane_under({sheet(kGlassTint, 20, MaterialClass::translucent)});
    SceneObject blocker = sheet({}, 20, MaterialClass::other);
    for (Vec3& p : blocker.mesh.positions_mm) p = p + Vec3{-60, 0, 0};
    scene.objects.push_back(blocker);
    // 45 degrees from the right: shadows lie 20 mm to the left of what casts them.
    // Its shadow is the technique's own here, not a map of the scene's budget.
    scene.lights.push_back({.name = "fill",
                            .intensity = kIrradiance,
                            .to_light_world = normalize({1, 0, 1}),
                            .casts_shadow = false});
    EXPECT_TRUE(complete_scene(scene));
    Renderer renderer = make_renderer(scene);
    const float fill = kIrradiance * std::sqrt(0.5f);
    const Image off = light_map(renderer, {});
    const Image on = light_map(renderer, {{"shadows", "two_lights"}});
    const auto texel = [](float x_mm) { return int((x_mm + 50) / 100 * 64); };
    // At x = 30 the key light and the fill both come through the surface; one channel of opacity each.
    EXPECT_NEAR(off.at(texel(30), 32, 1), kIrradiance * kGlassTint.y + fill, 5e-3f);
    EXPECT_NEAR(on.at(texel(30), 32, 1), (kIrradiance + fill) * kGlassTint.x, 5e-3f);
    // At x = -7 the fill comes through the surface, at -35 it meets the blocker.
    EXPECT_NEAR(on.at(texel(-7), 32, 0), fill * kGlassTint.x, 5e-3f);
    EXPECT_NEAR(on.at(texel(-35), 32, 0), 0, 5e-3f);
    EXPECT_NEAR(off.at(texel(-35), 32, 0), fill, 5e-3f);
}

TEST_F(TranslucentShadow, glass_is_drawn_over_the_picture_as_a_product) {
    Scene bare = plane_under({}), glazed = plane_under({sheet(kGlassTint, 20, MaterialClass::translucent)});
    // The light's own way through the glass is not what is measured here.
    bare.lights[0].casts_shadow = glazed.lights[0].casts_shadow = false;
    Scene same_view = bare;
    same_view.camera = glazed.camera;
    Renderer without = make_renderer(same_view), with = make_renderer(glazed);
    const Technique& lambert = built_in_technique("lambert");
    const DrawSettings settings = {.width = 64, .height = 64, .view = "diffuse", .shadow_map_size = 256};
    const Image a = radiance(without, lambert, settings), b = radiance(with, lambert, settings);
    size_t tinted = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            if (a.at(x, y, 3) < 1) continue;
            const float red = b.at(x, y, 0) / a.at(x, y, 0), blue = b.at(x, y, 2) / a.at(x, y, 2);
            tinted += std::abs(red - kGlassTint.x) < 0.06f && std::abs(blue - kGlassTint.z) < 0.06f;
        }
    EXPECT_GT(tinted, 200u);
}
