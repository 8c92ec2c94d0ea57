// normals=baked: on spheres it is the table without it, silhouettes included. normals=auto is baked where the
// head and the settings allow it, else blended.

#include <gmock/gmock.h>

#include "dermis/mesh/primitives.h"
#include "dermis/scene/placement.h"
#include "render/grid_scene.h"
#include "support/built_in.h"

using namespace dermis;
using testing::AllOf;
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

TEST_F(BakedNormals, are_the_default_where_head_and_settings_allow_it) {
    const Scene scene = two_balls();
    Renderer renderer = make_renderer(scene);
    const Image baked = drawn(renderer, {{"normals", "baked"}}), blended = drawn(renderer, {});
    EXPECT_NE(baked.bytes, blended.bytes);
    EXPECT_EQ(drawn(renderer, {{"normals", "auto"}}).bytes, baked.bytes);
    EXPECT_THAT(renderer.warnings(), IsEmpty());
    for (const auto& [name, value] : Settings{{"curvature", "derivative"},
                                              {"diffuse", "half_ring"},
                                              {"ambient", "curve_2015"},
                                              {"diffuse", "closed_form"}})
        EXPECT_EQ(drawn(renderer, {{"normals", "auto"}, {name, value}}).bytes,
                  drawn(renderer, {{name, value}}).bytes)
            << name << " " << value;
}

// At a silhouette a pixel covers a wide part of the atlas, of which the narrow side chooses the level.
TEST_F(BakedNormals, of_spheres_give_the_table_at_the_middle_and_at_silhouettes) {
    const Scene scene = load("builtin:spheres");
    EXPECT_LT(difference(drawn(scene, {{"normals", "baked"}}), drawn(scene, {{"normals", "sharp"}})), 0.03);
}

TEST_F(BakedNormals, that_the_head_does_not_allow_are_refused_and_auto_says_why_it_is_blended) {
    Scene without_uvs = two_balls(), shared_texels = two_balls();
    without_uvs.objects[1].mesh.uvs.clear();
    shared_texels.objects[1].mesh.uvs = shared_texels.objects[0].mesh.uvs;
    for (const auto& [scene, reason] :
         {std::pair{&without_uvs, "has no UVs"}, {&shared_texels, "covered by more than one triangle"}}) {
        Renderer renderer = make_renderer(*scene);
        const auto refused = renderer.draw(technique(), values_of({{"normals", "baked"}}), kSmall);
        ASSERT_FALSE(refused) << reason;
        EXPECT_THAT(refused.error().message, AllOf(HasSubstr(reason), HasSubstr("or set normals=auto")));
        const Image blended = drawn(renderer, {{"normals", "auto"}});
        EXPECT_THAT(renderer.warnings(),
                    Contains(AllOf(HasSubstr("is blended, not baked"), HasSubstr(reason))));
        EXPECT_EQ(blended.bytes, drawn(renderer, {}).bytes);
    }
    const FrameContext zonal = {.has_zonal_table = true};
    EXPECT_THAT(technique().build(values_of({{"normals", "baked"}}), zonal).refusal,
                HasSubstr("the scene's zonal_table"));
    EXPECT_THAT(technique().build(values_of({{"normals", "auto"}}), zonal).notices,
                Contains(HasSubstr("the scene's zonal_table")));
}

// In another tile no texel is read: there the skin is the sphere of its vertices' curvature.
TEST_F(BakedNormals, outside_the_atlas_scatter_by_the_curvature_of_the_vertices) {
    Scene scene = two_balls();
    for (Vec2& uv : scene.objects[1].mesh.uvs) uv.x += 1;
    EXPECT_LT(difference(drawn(scene, {{"normals", "baked"}}), drawn(scene, {{"normals", "sharp"}})), 0.03);
}
