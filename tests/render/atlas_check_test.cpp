#include <gmock/gmock.h>

#include "dermis/mesh/primitives.h"
#include "dermis/render/atlas_check.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/skin_atlas.h"
#include "render/render_test.h"
#include "support/built_in.h"
#include "support/uv_variants.h"

using namespace dermis;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

Scene one_sphere(Vec2 uv_offset = {}, float uv_scale = 1) {
    Scene scene;
    scene.objects.push_back({.name = "ball", .mesh = make_sphere(20, 16), .classes = {MaterialClass::skin}});
    scene.objects[0].mesh.materials[0].name = "hide";
    for (Vec2& uv : scene.objects[0].mesh.uvs) uv = uv * uv_scale + uv_offset;
    place_in_studio(scene);
    return scene;
}

class AtlasCheck : public RenderTest {};

}  // namespace

TEST_F(AtlasCheck, is_silent_about_a_good_atlas) {
    EXPECT_THAT(*check_skin_atlas(one_sphere()), IsEmpty());
    EXPECT_THAT(*check_skin_atlas(load("builtin:spheres")), IsEmpty());
}

TEST_F(AtlasCheck, skin_without_uvs_is_an_error_that_names_the_material_and_a_way_out) {
    Scene scene = one_sphere();
    scene.objects[0].mesh.uvs.clear();
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("texture_space");
    const auto drawn =
        renderer.draw(technique, ParameterValues(technique.parameters), {.width = 16, .height = 16});
    ASSERT_FALSE(drawn);
    EXPECT_THAT(drawn.error().message, HasSubstr("skin material 'hide' has no UVs"));
    const Technique& lambert = built_in_technique("lambert");
    EXPECT_TRUE(renderer.draw(lambert, ParameterValues(lambert.parameters), {.width = 16, .height = 16}));
}

TEST_F(AtlasCheck, says_once_where_the_layout_of_the_file_is_replaced) {
    Scene missing = one_sphere(), mirrored = one_sphere(), tiles = one_sphere({1, 0});
    missing.objects[0].mesh.uvs.clear();
    mirror_halves(mirrored.objects[0].mesh);
    for (Scene* scene : {&missing, &mirrored, &tiles}) lay_out_skin_atlas(*scene);
    EXPECT_THAT(*check_skin_atlas(missing),
                ElementsAre(HasSubstr("'hide' has no UVs, so Dermis makes some")));
    EXPECT_THAT(*check_skin_atlas(mirrored),
                ElementsAre(HasSubstr("'hide' overlap, so Dermis spreads them")));
    EXPECT_THAT(*check_skin_atlas(tiles), IsEmpty());
    EXPECT_EQ(unfit_for_baked_maps(missing), "");
}

TEST_F(AtlasCheck, other_udim_tiles_are_skipped_with_a_message) {
    EXPECT_THAT(*check_skin_atlas(one_sphere({1, 0})),
                ElementsAre(HasSubstr("'hide': UDIM tile 1002 is skipped")));
}

TEST_F(AtlasCheck, uvs_over_the_edge_are_lit_without_scattering) {
    EXPECT_THAT(*check_skin_atlas(one_sphere({0.25f, 0})), ElementsAre(HasSubstr("lie outside 0..1")));
}

TEST_F(AtlasCheck, overlap_is_reported_with_its_consequence) {
    Scene scene = one_sphere();
    scene.objects.push_back(scene.objects[0]);
    scene.objects[1].mesh.materials[0].name = "twin";
    EXPECT_THAT(*check_skin_atlas(scene), ElementsAre(testing::AllOf(HasSubstr("100 % of the skin's atlas"),
                                                                     HasSubstr("'hide', 'twin'"))));
}

// A scene that complete_scene() has not seen has no atlas of its own.
TEST_F(AtlasCheck, skin_outside_the_atlas_looks_like_lambert) {
    const Scene scene = one_sphere({1, 0});
    Renderer renderer = make_renderer(scene);
    const DrawSettings diffuse = {.width = 64, .height = 64, .view = "diffuse", .shadow_map_size = 256};
    const Image lambert = radiance(renderer, built_in_technique("lambert"), diffuse);
    for (const char* id : {"texture_space", "texture_space_gaussians"}) {
        ParameterValues values = profile_values(built_in_technique(id));
        ASSERT_TRUE(values.set("transmission", "none"));
        const Image drawn = radiance(renderer, built_in_technique(id), values, diffuse);
        EXPECT_LT(relative_difference(lambert, drawn, 1), 2e-3) << id;
        EXPECT_THAT(renderer.warnings(), ElementsAre(HasSubstr("UDIM tile 1002")));
    }
}
