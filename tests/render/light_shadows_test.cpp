// The part of each light that reaches a surface, in every technique and on surfaces other than skin: a plane
// under an opaque or tinted cover over the half where x > 0.

#include <gtest/gtest.h>

#include "dermis/mesh/primitives.h"
#include "dermis/scene/placement.h"
#include "render/render_test.h"

using namespace dermis;

namespace {

constexpr Vec3 kTint = {0.2f, 0.5f, 0.9f};

SceneObject cover(MaterialClass material_class) {
    SceneObject object{.name = "cover", .mesh = make_plane(60, 120), .classes = {material_class}};
    for (Vec3& p : object.mesh.positions_mm) p = p + Vec3{35, 0, 20};
    object.mesh.materials[0].base_color_linear = kTint;
    object.mesh.materials[0].opacity = material_class == MaterialClass::translucent ? 0.0f : 1.0f;
    object.mesh.materials[0].specular = 0;
    return object;
}

Light from_above(const char* name, bool is_key) {
    return {.name = name, .intensity = 3, .to_light_world = {0, 0, 1}, .is_key = is_key};
}

// Seen from the side where nothing covers the plane.
Scene plane_under(MaterialClass cover_class, MaterialClass plane_class, std::vector<Light> lights) {
    Scene scene;
    scene.objects.push_back({.name = "plane", .mesh = make_plane(100, 100, 8), .classes = {plane_class}});
    scene.objects.push_back(cover(cover_class));
    place_in_studio(scene);
    scene.environment.kind = EnvironmentKind::none;
    scene.lights = std::move(lights);
    scene.camera.eye_mm = {-400, 0, 250};
    scene.camera.target_mm = {0, 0, 0};
    scene.camera.up_world = {0, 0, 1};
    scene.camera.vertical_fov_rad = 0.15f;
    fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    EXPECT_TRUE(complete_scene(scene));
    return scene;
}

class LightShadows : public RenderTest {
  protected:
    struct Seen {
        Vec3 open, covered;
    };
    static Vec3 at(const Image& image, int x, int y) {
        return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
    }
    // 12 mm to each side of the middle: the far half, under the cover, is above it in the picture.
    static Seen drawn(const Scene& scene, const std::string& technique) {
        Renderer renderer = make_renderer(scene);
        return drawn(renderer, technique);
    }
    static Seen drawn(Renderer& renderer, const std::string& technique, const std::string& view = "final") {
        const Image image = radiance(renderer, built_in_technique(technique),
                                     {.width = 96, .height = 96, .view = view, .shadow_map_size = 512});
        return {at(image, 48, 57), at(image, 48, 39)};
    }
};

const char* const kForward[] = {"lambert", "oren_nayar", "wrap", "preintegrated", "texture_space_gaussians"};

}  // namespace

TEST_F(LightShadows, of_the_second_light_are_as_the_key_lights) {
    Light faint_key = from_above("key", true);
    faint_key.intensity = 0;
    const Scene scene =
        plane_under(MaterialClass::other, MaterialClass::skin, {faint_key, from_above("second", false)});
    Renderer renderer = make_renderer(scene);
    for (const char* technique : kForward) {
        const Seen seen = drawn(renderer, technique);
        EXPECT_GT(seen.open.x, 0.1f) << technique;
        EXPECT_LT(seen.covered.x, 0.02f * seen.open.x) << technique;
    }
}

TEST_F(LightShadows, darken_the_second_lights_specular_too) {
    Light faint_key = from_above("key", true), second = from_above("second", false);
    faint_key.intensity = 0;
    second.to_light_world = normalize(Vec3{0.98f, 0, 0.2f});
    Scene scene = plane_under(MaterialClass::other, MaterialClass::skin, {faint_key, second});
    scene.objects[1].mesh = scene.objects[0].mesh;
    for (Vec3& p : scene.objects[1].mesh.positions_mm) p = {60, p.x, p.y};  // a wall before the light
    Scene without = scene;
    without.lights[1].casts_shadow = false;
    Renderer renderer = make_renderer(scene), renderer_without = make_renderer(without);
    for (const char* technique : {"lambert", "texture_space", "texture_space_gaussians"}) {
        const Seen shadowed = drawn(renderer, technique, "specular"),
                   lit = drawn(renderer_without, technique, "specular");
        EXPECT_GT(lit.open.x, 1e-3f) << technique;
        EXPECT_LT(shadowed.open.x, 0.02f * lit.open.x) << technique;
    }
}

TEST_F(LightShadows, are_absent_where_the_key_light_casts_none) {
    Scene scene = plane_under(MaterialClass::other, MaterialClass::skin, {from_above("key", true)});
    scene.lights[0].casts_shadow = false;
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques) {
        const Seen seen = drawn(renderer, technique.id);
        EXPECT_GT(seen.covered.x, 0.9f * seen.open.x) << technique.id;
    }
}

TEST_F(LightShadows, follow_the_key_shadow_and_the_budget) {
    Light faint_key = from_above("key", true);
    faint_key.intensity = 0;
    Scene scene =
        plane_under(MaterialClass::other, MaterialClass::other, {faint_key, from_above("second", false)});
    EXPECT_EQ(scene.shadow_maps(), (std::vector{0, 1}));
    EXPECT_LT(drawn(scene, "lambert").covered.x, 0.01f);
    scene.shadow_map_budget = 1;
    EXPECT_EQ(scene.shadow_maps(), (std::vector{0, -1}));
    EXPECT_GT(drawn(scene, "lambert").covered.x, 0.1f);
    scene.shadow_map_budget = 3;
    scene.lights[1].casts_shadow = false;
    EXPECT_EQ(scene.shadow_maps(), (std::vector{0, -1}));
    EXPECT_GT(drawn(scene, "lambert").covered.x, 0.1f);
    scene.lights = {from_above("1", false), from_above("2", false), from_above("key", true),
                    from_above("3", false), from_above("4", false)};
    EXPECT_EQ(scene.shadow_maps(), (std::vector{1, 2, 0, -1, -1}));
}

TEST_F(LightShadows, of_translucent_surfaces_are_tinted_in_every_technique_and_on_eyes_and_frames) {
    for (const bool is_key : {true, false})
        for (const MaterialClass plane : {MaterialClass::skin, MaterialClass::other}) {
            std::vector<Light> lights = {from_above("key", true)};
            if (!is_key) lights[0].intensity = 0, lights.push_back(from_above("second", false));
            const Scene scene = plane_under(MaterialClass::translucent, plane, lights);
            Renderer renderer = make_renderer(scene);
            for (const char* technique : kForward) {
                const Seen seen = drawn(renderer, technique, "diffuse");
                const float share[3] = {seen.covered.x / seen.open.x, seen.covered.y / seen.open.y,
                                        seen.covered.z / seen.open.z};
                EXPECT_NEAR(share[0], kTint.x, 0.02f) << technique << " key " << is_key;
                EXPECT_NEAR(share[1], kTint.y, 0.02f) << technique << " key " << is_key;
                EXPECT_NEAR(share[2], kTint.z, 0.02f) << technique << " key " << is_key;
            }
        }
}
