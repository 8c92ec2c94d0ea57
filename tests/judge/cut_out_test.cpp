// Cards of hair and lashes, maps of emission and vertex colours: the renderer and the reference show the
// same, and both what the material says.

#include "dermis/mesh/primitives.h"
#include "dermis/reference/picture.h"
#include "dermis/scene/placement.h"
#include "render/render_test.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

constexpr int kPictureSide = 64;
constexpr Vec3 kCardColor = {1, 0, 0}, kSkinColor = {1, 1, 1};

// Sixteen texels side by side, eight of each; a card's u grows with x.
ImageSource halves(const std::string& name, const std::vector<int>& left, const std::vector<int>& right) {
    constexpr int kWidth = 16;
    std::vector<std::byte> pixels;
    for (int x = 0; x < kWidth; ++x)
        for (const int code : x < kWidth / 2 ? left : right) pixels.push_back(std::byte(code));
    return {.name = name,
            .width = kWidth,
            .height = 1,
            .channels = int(left.size()),
            .pixels = std::move(pixels)};
}

// A red card of 40 mm, 20 mm over white skin.
Scene card_over_skin(const std::function<void(Material&)>& make_card) {
    Scene scene;
    scene.objects.push_back({.name = "skin", .mesh = make_plane(100, 100), .classes = {MaterialClass::skin}});
    SceneObject card{.name = "card", .mesh = make_plane(40, 40), .classes = {MaterialClass::other}};
    for (Vec3& p : card.mesh.positions_mm) p.z += 20;
    card.mesh.materials[0].base_color_linear = kCardColor;
    make_card(card.mesh.materials[0]);
    scene.objects[0].mesh.materials[0].base_color_linear = kSkinColor;
    scene.objects.push_back(std::move(card));
    for (SceneObject& object : scene.objects) {
        object.mesh.materials[0].specular = 0;
        object.mesh.occlusions.assign(object.mesh.positions_mm.size(), 1.0f);
    }
    place_in_studio(scene);
    scene.environment.kind = EnvironmentKind::none;
    // From the left, down at 45 degrees: shadows lie 20 mm to the right of what casts them.
    scene.lights = {
        {.name = "key", .intensity = 1, .to_light_world = normalize(Vec3{-1, 0, 1}), .is_key = true}};
    return scene;
}

class CutOut : public RenderTest {
  protected:
    struct Pictures {
        Image drawn, reference;
        Mat4 view_projection;
    };

    static Pictures pictures(Scene scene) {
        EXPECT_TRUE(complete_scene(scene));
        Renderer renderer = make_renderer(scene);
        Image drawn = radiance(renderer, built_in_technique("lambert"),
                               {.width = kPictureSide,
                                .height = kPictureSide,
                                .samples = 1,
                                .view = "diffuse",
                                .penumbra_mm = 0.1f});
        ReferenceSettings settings{
            .integrator = Integrator::lambert, .width = kPictureSide, .height = kPictureSide, .samples = 4};
        settings.filter = PixelFilter::center;
        settings.lighting = {.ambient = AmbientModel::renderer, .specular = SpecularReflection::none};
        auto reference = render_reference(scene, settings);
        EXPECT_TRUE(reference) << reference.error().message;
        return {std::move(drawn), std::move(reference->radiance),
                camera_matrices(scene.camera, 1).view_projection};
    }

    static void expect_at(const Pictures& pictures, Vec3 p_mm, Vec3 expected) {
        const auto& m = pictures.view_projection.m;
        const auto row = [&](size_t r) {
            return m[r] * p_mm.x + m[r + 4] * p_mm.y + m[r + 8] * p_mm.z + m[r + 12];
        };
        const int x = int((row(0) / row(3) * 0.5f + 0.5f) * kPictureSide),
                  y = int((row(1) / row(3) * 0.5f + 0.5f) * kPictureSide);
        for (const Image* image : {&pictures.drawn, &pictures.reference})
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(image->at(x, y, c), (&expected.x)[c], 0.01f)
                    << (image == &pictures.drawn ? "renderer" : "reference") << " at " << p_mm.x
                    << ", channel " << c;
    }
};

const float kLit = std::sqrt(0.5f) / 3.14159265f;  // radiance of white where light arrives at 45 degrees

}  // namespace

TEST_F(CutOut, shows_what_is_behind_and_casts_no_shadow_where_alpha_is_low) {
    struct Case {
        const char* name;
        std::function<void(Material&)> make;
    };
    const auto base = [](Material& m) {
        m.base_color_map = halves("rgba", {255, 255, 255, 255}, {255, 255, 255, 40});
    };
    const Case cases[] = {{"mask", [&](Material& m) { base(m), m.alpha_mode = AlphaMode::mask; }},
                          {"mask of half opacity",
                           [&](Material& m) {
                               base(m), m.alpha_mode = AlphaMode::mask;
                               m.opacity = 0.5f, m.alpha_cutoff = 0.1f;
                           }},
                          {"own map", [&](Material& m) {
                               m.alpha_map = halves("alpha", {255}, {40});
                               m.alpha_mode = AlphaMode::mask;
                           }}};
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const Pictures p = pictures(card_over_skin(c.make));
        expect_at(p, {-10, 0, 20}, kCardColor * kLit);
        expect_at(p, {10, 0, 0}, {});  // the left half's shadow, seen through the right half
        expect_at(p, {30, 0, 0}, kSkinColor * kLit);
    }
}

// The shadow, cut out at 0.5 of the map, is that of the left half alone.
TEST_F(CutOut, blends_what_is_blended_over_what_is_behind) {
    const Pictures p = pictures(card_over_skin([](Material& m) {
        m.base_color_map = halves("rgba", {255, 255, 255, 204}, {255, 255, 255, 102});
        m.alpha_mode = AlphaMode::blend;
        m.opacity = 0.75f;
    }));
    expect_at(p, {-10, 0, 20}, (kCardColor * 0.6f + kSkinColor * 0.4f) * kLit);
    expect_at(p, {10, 0, 20}, kCardColor * 0.3f * kLit);
    expect_at(p, {30, 0, 0}, kSkinColor * kLit);
}

TEST_F(CutOut, blends_without_a_map_and_where_a_scene_file_says_so) {
    for (const AlphaMode mode : {AlphaMode::blend, AlphaMode::opaque}) {
        for (const float opacity : {0.4f, 0.6f}) {
            const Pictures p =
                pictures(card_over_skin([&](Material& m) { m.alpha_mode = mode, m.opacity = opacity; }));
            const Vec3 behind = kSkinColor * (1 - opacity);
            expect_at(p, {-10, 0, 20}, (kCardColor * opacity + behind) * kLit);
            expect_at(p, {30, 0, 0}, opacity > 0.5f ? Vec3{} : kSkinColor * kLit);
        }
    }
}

// Of the skin behind both, a quarter remains.
TEST_F(CutOut, a_card_that_covers_most_hides_one_behind_it_that_is_drawn_later) {
    Scene scene = card_over_skin([](Material& m) { m.opacity = 0.75f; });
    SceneObject behind = scene.objects[1];
    for (Vec3& q : behind.mesh.positions_mm) q.z -= 10;
    behind.mesh.materials[0].base_color_linear = {0, 1, 0};
    scene.objects.push_back(behind);
    const Image drawn = pictures(scene).drawn;
    EXPECT_NEAR(drawn.at(kPictureSide / 2, kPictureSide / 2, 0), 0.75f * kLit, 0.25f * kLit);
    EXPECT_LE(drawn.at(kPictureSide / 2, kPictureSide / 2, 1), 0.25f * kLit);
}

TEST_F(CutOut, needs_a_mode_and_a_cutoff_above_the_map) {
    const auto base = [](Material& m) {
        m.base_color_map = halves("rgba", {255, 255, 255, 255}, {255, 255, 255, 40});
    };
    for (const auto& make : std::initializer_list<std::function<void(Material&)>>{
             base, [&](Material& m) { base(m), m.alpha_mode = AlphaMode::mask, m.alpha_cutoff = 0.1f; }}) {
        const Pictures p = pictures(card_over_skin(make));
        expect_at(p, {-10, 0, 20}, kCardColor * kLit);
        expect_at(p, {10, 0, 20}, kCardColor * kLit);
        expect_at(p, {30, 0, 0}, {});
    }
}

TEST_F(CutOut, counts_the_alpha_of_vertex_colours) {
    Scene scene = card_over_skin([](Material& m) { m.alpha_mode = AlphaMode::mask; });
    Mesh& card = scene.objects[1].mesh;
    for (const Vec3& p : card.positions_mm) card.colors_linear.push_back({1, 1, 1, p.x < 0 ? 1.0f : 0.0f});
    const Pictures p = pictures(scene);
    expect_at(p, {-10, 0, 20}, kCardColor * kLit);
    expect_at(p, {10, 0, 0}, {});
    expect_at(p, {30, 0, 0}, kSkinColor * kLit);
}

TEST_F(CutOut, leaves_skin_whole) {
    Scene scene = card_over_skin([](Material& m) {
        m.base_color_map = halves("rgba", {255, 255, 255, 255}, {255, 255, 255, 0});
        m.alpha_mode = AlphaMode::mask;
    });
    scene.objects[1].classes = {MaterialClass::skin};
    scene.objects[1].mesh.materials[0].opacity = 0.5f;
    expect_at(pictures(scene), {10, 0, 20}, kCardColor * kLit);
}

TEST_F(CutOut, surfaces_emit_what_their_map_says) {
    Scene scene = card_over_skin([](Material& m) {
        m.emission_linear = {2, 1, 0.5f};
        m.emission_map = halves("emission", {255, 255, 255}, {0, 0, 0});
    });
    scene.objects[0].mesh.materials[0].emission_linear = {0, 0, 3};
    scene.lights[0].intensity = 0;
    const Pictures p = pictures(scene);
    expect_at(p, {-10, 0, 20}, {2, 1, 0.5f});
    expect_at(p, {10, 0, 20}, {});
    expect_at(p, {30, 0, 0}, {0, 0, 3});
    scene.objects[1].classes = {MaterialClass::skin};
    const Pictures of_skin = pictures(scene);
    expect_at(of_skin, {-10, 0, 20}, {2, 1, 0.5f});
    expect_at(of_skin, {10, 0, 20}, {});
}

// Only surfaces other than metal reflect their colour diffusely.
TEST_F(CutOut, a_map_of_metal_counts_by_its_red_channel) {
    Scene scene = card_over_skin([](Material& m) {
        m.metallic = 1;
        m.metallic_map = halves("metal", {255, 0, 0}, {0, 255, 255});
        m.metallic_roughness_map = halves("replaced", {0, 255, 0}, {0, 255, 255});
    });
    const Pictures p = pictures(scene);
    EXPECT_LT(p.reference.at(24, 32, 0), 0.01f);
    expect_at(p, {10, 0, 20}, kCardColor * kLit);
}

// u runs over the card three times; the map is bright in its left half.
TEST_F(CutOut, maps_are_clamped_and_mirrored_as_their_samplers_say) {
    struct Case {
        TextureWrap wrap;
        bool lit_before, lit_after;  // at u of -0.25 and 1.25
    };
    for (const Case& c : {Case{TextureWrap::repeat, false, true}, Case{TextureWrap::clamp, true, false},
                          Case{TextureWrap::mirror, true, false}})
        for (const bool of_alpha : {false, true})
            for (const MaterialClass material_class : {MaterialClass::other, MaterialClass::skin}) {
                if (of_alpha && material_class == MaterialClass::skin) continue;  // is never cut out
                SCOPED_TRACE(int(c.wrap) * 10 + of_alpha);
                Scene scene = card_over_skin([&](Material& m) {
                    m.base_color_map = of_alpha ? halves("alpha", {255, 255, 255, 255}, {255, 255, 255, 0})
                                                : halves("color", {255}, {0});
                    m.base_color_map.wrap_u = c.wrap;
                    if (of_alpha) m.alpha_mode = AlphaMode::mask;
                });
                scene.objects[1].classes = {material_class};
                for (Vec2& uv : scene.objects[1].mesh.uvs) uv.x = 3 * uv.x - 1;
                scene.objects[0].mesh.materials[0].base_color_linear = {};
                const Pictures p = pictures(scene);
                const auto color = [](bool lit) { return lit ? kCardColor * kLit : Vec3{}; };
                expect_at(p, {-10, 0, 20}, color(c.lit_before));
                expect_at(p, {10, 0, 20}, color(c.lit_after));
            }
}

TEST_F(CutOut, vertex_colours_multiply_the_base_colour) {
    Scene scene = card_over_skin([](Material&) {});
    for (SceneObject& object : scene.objects)
        for (const Vec3& p : object.mesh.positions_mm)
            object.mesh.colors_linear.push_back(p.x < 0 ? Vec4{0.5f, 1, 1, 1} : Vec4{1, 0.5f, 1, 1});
    scene.lights[0].to_light_world = {0, 0, 1};
    const Pictures p = pictures(scene);
    const float lit = 1 / 3.14159265f;
    expect_at(p, {0, 0, 20}, Vec3{0.75f, 0, 0} * lit);
    expect_at(p, {-25, 0, 0}, Vec3{0.625f, 0.875f, 1} * lit);
    expect_at(p, {25, 0, 0}, Vec3{0.875f, 0.625f, 1} * lit);
}
