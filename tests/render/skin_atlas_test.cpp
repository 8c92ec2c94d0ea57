// The same head with UVs as other tools make them looks as with one clean atlas.

#include "dermis/scene/skin_atlas.h"

#include <map>

#include <gmock/gmock.h>

#include "dermis/mesh/primitives.h"
#include "dermis/render/atlas_check.h"
#include "dermis/scene/placement.h"
#include "render/render_test.h"
#include "support/uv_variants.h"

using namespace dermis;
using testing::IsEmpty;

namespace {

class SkinAtlasPicture : public RenderTest {
  protected:
    static inline const DrawSettings kSmall = {
        .width = 128, .height = 128, .view = "diffuse", .shadow_map_size = 1024};

    static ParameterValues values_of(const Technique& technique) {
        ParameterValues values(technique.parameters);
        if (technique.parameters.find("light_map_size")) EXPECT_TRUE(values.set("light_map_size", "512"));
        if (technique.id == "preintegrated") EXPECT_TRUE(values.set("normals", "baked"));
        return values;
    }

    static Image drawn(Renderer& renderer, const std::string& id) {
        const Technique& technique = built_in_technique(id);
        return radiance(renderer, technique, values_of(technique), kSmall);
    }

    // Error against `wanted`, relative to what scattering changes there; root mean squares.
    static double error_of(const Image& image, const Image& wanted, const Image& lambert) {
        double error = 0, effect = 0;
        for (size_t i = 0; i < wanted.floats().size(); ++i) {
            if (i % 4 == 3) continue;
            error += std::pow(image.floats()[i] - wanted.floats()[i], 2);
            effect += std::pow(wanted.floats()[i] - lambert.floats()[i], 2);
        }
        return std::sqrt(error / effect);
    }
};

}  // namespace

TEST_F(SkinAtlasPicture, tiles_mirrored_halves_and_eight_materials_look_like_one_atlas) {
    Scene clean = bust_without_maps(), without_layout = clean;
    split_into_eight_materials(skin_of(without_layout), clean.bounds_center_mm);
    EXPECT_TRUE(skin_of(clean).mesh.atlas_uvs.empty());
    Renderer of_clean = make_renderer(clean);
    const Image lambert = drawn(of_clean, "lambert");
    std::map<std::string, Image> wanted;
    for (const char* id : {"texture_space", "texture_space_gaussians", "preintegrated"})
        wanted[id] = drawn(of_clean, id);
    for (const UvVariant& variant : uv_variants(clean)) {
        Renderer renderer = make_renderer(variant.scene);
        for (const auto& [id, image] : wanted) {
            // Other texels alone make .07 to .19 of it, along the mouth and the eyelids.
            EXPECT_LT(error_of(drawn(renderer, id), image, lambert), 0.25) << variant.name << " " << id;
        }
    }
    Renderer shared = make_renderer(without_layout);
    const std::string id = "texture_space_gaussians";
    EXPECT_GT(error_of(drawn(shared, id), wanted[id], lambert), 1.0);
}

TEST_F(SkinAtlasPicture, skin_without_uvs_scatters_as_with_a_clean_atlas) {
    Scene clean;
    clean.objects.push_back({.name = "ball", .mesh = make_sphere(12, 96), .classes = {MaterialClass::skin}});
    place_in_studio(clean);
    ASSERT_TRUE(complete_scene(clean));
    Scene without_uvs = clean;
    without_uvs.objects[0].mesh.uvs.clear();
    lay_out_skin_atlas(without_uvs);
    Renderer of_clean = make_renderer(clean), renderer = make_renderer(without_uvs);
    const Image lambert = drawn(of_clean, "lambert");
    for (const char* id : {"texture_space", "texture_space_gaussians", "preintegrated"})
        EXPECT_LT(error_of(drawn(renderer, id), drawn(of_clean, id), lambert), 0.05) << id;
}

TEST_F(SkinAtlasPicture, no_skin_is_left_alone) {
    Scene scene;
    scene.objects.push_back(
        {.name = "stone", .mesh = make_sphere(20, 16), .classes = {MaterialClass::other}});
    place_in_studio(scene);
    ASSERT_TRUE(complete_scene(scene));
    EXPECT_TRUE(scene.objects[0].mesh.atlas_uvs.empty());
    EXPECT_TRUE(skin_over_atlas(scene).parts.empty());
    EXPECT_THAT(*check_skin_atlas(scene), IsEmpty());
}

TEST_F(SkinAtlasPicture, only_skin_gets_texels) {
    Scene scene;
    for (int i = 0; i < 3; ++i)
        scene.objects.push_back({.name = "ball",
                                 .mesh = make_sphere(20, 16),
                                 .classes = {i == 1 ? MaterialClass::other : MaterialClass::skin}});
    place_in_studio(scene);
    ASSERT_TRUE(complete_scene(scene));
    EXPECT_TRUE(scene.objects[1].mesh.atlas_uvs.empty());
    const SkinParts skin = skin_over_atlas(scene);
    ASSERT_EQ(skin.parts.size(), 2u);
    EXPECT_THAT(*check_skin_atlas(scene), IsEmpty());
}
