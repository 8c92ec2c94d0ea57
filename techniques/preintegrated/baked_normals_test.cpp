// normals=baked: on spheres it is the table as ever, silhouettes included, and without an atlas of the skin's
// own it is normals=blended.

#include <gmock/gmock.h>

#include "dermis/mesh/primitives.h"
#include "dermis/scene/placement.h"
#include "render/grid_scene.h"
#include "support/built_in.h"

using namespace dermis;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

class BakedNormals : public PreintegratedTest {
  protected:
    static inline const DrawSettings kSmall = {.width = 96, .height = 96, .view = "diffuse"};

    static Image drawn(Renderer& renderer, const Settings& settings) {
        return radiance(renderer, technique(), values_of(settings), kSmall);
    }
    static Image drawn(const Scene& scene, const Settings& settings) {
        Renderer renderer = make_renderer(scene);
        return drawn(renderer, settings);
    }
    static Scene two_balls() {
        Scene scene;
        for (const float x : {-25.0f, 25.0f}) {
            SceneObject ball{.name = "ball", .mesh = make_sphere(20, 24), .classes = {MaterialClass::skin}};
            for (Vec3& p : ball.mesh.positions_mm) p.x += x;
            for (Vec2& uv : ball.mesh.uvs) uv.x = 0.5f * uv.x + (x > 0 ? 0.5f : 0.0f);
            scene.objects.push_back(std::move(ball));
        }
        place_in_studio(scene);
        EXPECT_TRUE(complete_scene(scene));
        return scene;
    }
    // Largest difference of the two pictures, over the brightest value.
    static double difference(const Image& a, const Image& b) {
        double largest = 0, brightest = 0;
        for (size_t i = 0; i < a.floats().size(); ++i) {
            largest = std::max(largest, double(std::abs(a.floats()[i] - b.floats()[i])));
            if (i % 4 != 3) brightest = std::max(brightest, double(a.floats()[i]));
        }
        return largest / brightest;
    }
};

}  // namespace

TEST_F(BakedNormals, are_the_default) {
    const Scene scene = two_balls();
    Renderer renderer = make_renderer(scene);
    const ParameterValues defaults(technique().parameters);
    const Image as_default = radiance(renderer, technique(), defaults, kSmall);
    EXPECT_EQ(drawn(renderer, {{"normals", "baked"}}).bytes, as_default.bytes);
    EXPECT_NE(drawn(renderer, {}).bytes, as_default.bytes);
    EXPECT_THAT(renderer.warnings(), IsEmpty());
}

// At a silhouette a pixel covers a wide part of the atlas, of which the narrow side chooses the level.
TEST_F(BakedNormals, of_spheres_give_the_table_at_the_middle_and_at_silhouettes) {
    const Scene scene = load("builtin:spheres");
    EXPECT_LT(difference(drawn(scene, {{"normals", "baked"}}), drawn(scene, {{"normals", "sharp"}})), 0.03);
}

TEST_F(BakedNormals, without_uvs_are_blended_and_a_warning_says_so) {
    Scene scene = two_balls();
    scene.objects[1].mesh.uvs.clear();
    Renderer renderer = make_renderer(scene);
    const Image baked = drawn(renderer, {{"normals", "baked"}});
    EXPECT_THAT(renderer.warnings(), Contains(HasSubstr("has no UVs: nothing is baked over it")));
    EXPECT_EQ(baked.bytes, drawn(scene, {}).bytes);
}

TEST_F(BakedNormals, over_an_atlas_that_two_places_share_are_blended) {
    Scene scene = two_balls();
    scene.objects[1].mesh.uvs = scene.objects[0].mesh.uvs;
    Renderer renderer = make_renderer(scene);
    const Image baked = drawn(renderer, {{"normals", "baked"}});
    EXPECT_THAT(renderer.warnings(),
                Contains(HasSubstr("covered by more than one triangle: nothing is baked")));
    EXPECT_EQ(baked.bytes, drawn(scene, {}).bytes);
}

// In another tile no texel is read: there the skin is the sphere of its vertices' curvature.
TEST_F(BakedNormals, outside_the_atlas_scatter_by_the_curvature_of_the_vertices) {
    Scene scene = two_balls();
    for (Vec2& uv : scene.objects[1].mesh.uvs) uv.x += 1;
    EXPECT_LT(difference(drawn(scene, {{"normals", "baked"}}), drawn(scene, {{"normals", "sharp"}})), 0.03);
}

TEST_F(BakedNormals, leave_other_sources_of_curvature_and_ambient_light_their_effect) {
    const Scene scene = two_balls();
    for (const Settings& other : {Settings{{"curvature", "derivative"}},
                                  {{"construction", "ring"}},
                                  {{"ambient", "curve_2015"}},
                                  {{"diffuse", "closed_form"}}}) {
        Settings baked = other;
        baked.emplace_back("normals", "baked");
        EXPECT_EQ(drawn(scene, baked).bytes, drawn(scene, other).bytes) << other[0].first;
    }
}
