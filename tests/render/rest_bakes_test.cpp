// Bakes of a rest pose on a posed mesh.

#include "dermis/scene/rest_bakes.h"

#include <gmock/gmock.h>

#include <cmath>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/carried_bakes.h"
#include "dermis/scene/place_mesh.h"
#include "dermis/technique/technique_list.h"
#include "render/render_test.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

constexpr DrawSettings kRestPicture = {.width = 64, .height = 64, .deep = true, .shadow_map_size = 512};

// A cylinder's normals spread along one direction only.
Scene unit_shape(const std::string& shape) {
    auto scene =
        load_scene("unit", {.subjects = built_in_catalog().subjects, .words = {{"mesh.shape", shape}}});
    EXPECT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(complete_scene(*scene));
    return std::move(*scene);
}

Scene turned(Scene scene) {
    for (SceneObject& object : scene.objects)
        place_mesh(object.mesh, {.scale = 1, .rotation_rad = {0.5f, 0.8f, -0.4f}, .translation_mm = {}});
    return scene;
}

class RestBakesPicture : public RenderTest {
  protected:
    static std::vector<std::byte> drawn(const Scene& scene, const std::string& technique) {
        const auto parsed = parse_technique(built_in_catalog().techniques, technique);
        EXPECT_TRUE(parsed) << parsed.error().message;
        Renderer renderer = make_renderer(scene);
        return radiance(renderer, *parsed->technique, parsed->values, kRestPicture).bytes;
    }
};

}  // namespace

TEST(RestBakes, are_words_joined_by_plus) {
    for (const char* text : {"none", "normals", "curvature+gain", "normals+stencils+gain", "all"}) {
        const Result<RestBakes> bakes = parse_rest_bakes(text);
        ASSERT_TRUE(bakes) << bakes.error().message;
        EXPECT_EQ(rest_bakes_text(*bakes), text);
    }
    EXPECT_EQ(rest_bakes_text(*parse_rest_bakes("normals+curvature+gain+occlusion")), "all");
    EXPECT_THAT(parse_rest_bakes("normal").error().message, HasSubstr("did you mean 'normals'?"));
    EXPECT_FALSE(parse_rest_bakes(""));
    EXPECT_THAT(parse_rest_bakes("curvature+stencils").error().message, HasSubstr("name one of them"));
}

TEST(RestBakes, turn_with_a_surface_that_only_turns) {
    const Scene rest = unit_shape("cylinder"), posed = turned(rest);
    const GaussianSum profile = to_gaussian_sum(*find_profile("gpu_gems_3")).sum;
    const DiffusedNormalsRequest request{.size = 128, .finest_variance_mm2 = 0.1f};
    const auto baked = bake_diffused_normals(rest, profile, request),
               remade = bake_diffused_normals(posed, profile, request);
    ASSERT_TRUE(baked && remade);
    const DiffusedNormals carried = carried_normals(rest.objects, posed.objects, *baked);
    double wrong = 0, moved = 0;
    for (size_t i = 0; i < carried.red.size(); ++i)
        for (size_t c = 0; c < 4; ++c) {
            wrong += std::abs(int(carried.red[i][c]) - int(remade->red[i][c]));
            moved += std::abs(int(baked->red[i][c]) - int(remade->red[i][c]));
        }
    EXPECT_GT(moved, 1e3 * double(carried.red.size())) << "the directions have turned far";
    EXPECT_LT(wrong, 0.01 * moved);

    const auto curvatures = carried_curvatures(rest.objects[0].mesh, posed.objects[0].mesh);
    for (size_t i = 0; i < curvatures.size(); ++i) {
        const CurvatureTensor &is = curvatures[i], &should = posed.objects[0].mesh.curvatures_per_mm[i];
        ASSERT_NEAR(length(is.diagonal - should.diagonal) + length(is.mixed - should.mixed), 0, 1e-3) << i;
    }
}

TEST(RestBakes, keep_the_curvature_of_a_surface_that_grows) {
    const Mesh rest = unit_shape("cylinder").objects[0].mesh;
    Mesh posed = rest;
    place_mesh(posed, {.scale = 2, .rotation_rad = {}, .translation_mm = {}});
    const auto curvatures = carried_curvatures(rest, posed);
    for (size_t i = 0; i < curvatures.size(); ++i) {
        ASSERT_NEAR(mean_curvature(curvatures[i]), mean_curvature(rest.curvatures_per_mm[i]), 1e-5) << i;
        ASSERT_NEAR(2 * mean_curvature(posed.curvatures_per_mm[i]), mean_curvature(curvatures[i]), 1e-4);
    }
}

TEST_F(RestBakesPicture, of_a_scene_at_rest_is_byte_equal) {
    const Scene scene = unit_shape("cylinder");
    Scene rest = scene;
    rest.rest_objects = scene.objects;
    rest.rest_bakes = *parse_rest_bakes("all");
    for (const char* technique : {"preintegrated[gain=map]", "preintegrated[gain=curvature,normals=blended]",
                                  "texture_space_gaussians"})
        EXPECT_EQ(drawn(scene, technique), drawn(rest, technique)) << technique;
}

TEST_F(RestBakesPicture, of_another_shape_changes_only_what_the_technique_reads) {
    Scene scene = unit_shape("cylinder");
    scene.rest_objects = scene.objects;
    for (SceneObject& object : scene.rest_objects)
        place_mesh(object.mesh, {.scale = 3, .rotation_rad = {}, .translation_mm = {}});
    const auto with = [&](const char* bakes) {
        Scene posed = scene;
        posed.rest_bakes = *parse_rest_bakes(bakes);
        return posed;
    };
    const std::string baked = "preintegrated[normals=baked]", map = "preintegrated[normals=blended,gain=map]",
                      vertex = "preintegrated[normals=blended]";
    EXPECT_NE(drawn(with("none"), baked), drawn(with("normals"), baked));
    EXPECT_NE(drawn(with("none"), map), drawn(with("gain"), map));
    EXPECT_NE(drawn(with("none"), vertex), drawn(with("curvature"), vertex));
    EXPECT_EQ(drawn(with("none"), vertex), drawn(with("normals+gain"), vertex));
}
