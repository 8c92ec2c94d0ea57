// Walks for a gain are made while the window goes on.

#include <gtest/gtest.h>

#include "dermis/mesh/primitives.h"
#include "dermis/render/complete_scene.h"
#include "dermis/view/background_walks.h"
#include "dermis/view/stage.h"
#include "support/built_in.h"
#include "support/gpu_fixture.h"

namespace dermis::view {
namespace {

Scene small_ball() {
    Scene scene;
    scene.objects = {{.name = "ball", .mesh = make_sphere(4, 12), .classes = {MaterialClass::skin}}};
    scene.skin.profile = "openpbr_skin_3";
    return scene;
}

void await(BackgroundWalks& walks) {
    EXPECT_TRUE(walks.are_walking());
    walks.wait();
    EXPECT_TRUE(walks.take());
    EXPECT_FALSE(walks.are_walking());
    EXPECT_FALSE(walks.take());
}

TEST(BackgroundWalks, are_made_once_for_each_gain_and_shape) {
    const Scene scene = small_ball();
    BackgroundWalks walks;
    EXPECT_TRUE(walks.have(scene, Gain::none));
    EXPECT_TRUE(walks.have(scene, Gain::curvature));
    EXPECT_FALSE(walks.are_walking());
    EXPECT_FALSE(walks.have(scene, Gain::links));
    EXPECT_FALSE(walks.have(scene, Gain::map)) << "awaits the links";
    await(walks);
    EXPECT_TRUE(walks.have(scene, Gain::links));
    EXPECT_FALSE(walks.have(scene, Gain::map));
    await(walks);
    EXPECT_TRUE(walks.have(scene, Gain::map));
    walks.forget();
    EXPECT_FALSE(walks.have(scene, Gain::links));
}

TEST(BackgroundWalks, of_a_skin_that_is_gone_are_stopped) {
    Scene scene = small_ball();
    BackgroundWalks walks;
    const std::string first = scene.skin.profile;
    EXPECT_FALSE(walks.have(scene, Gain::links));
    scene.skin.profile = "openpbr_skin_4";
    EXPECT_FALSE(walks.have(scene, Gain::links));
    await(walks);
    EXPECT_FALSE(walks.have(scene, Gain::links));
    await(walks);
    EXPECT_TRUE(walks.have(scene, Gain::links));
    scene.skin.profile = first;
    EXPECT_FALSE(walks.have(scene, Gain::links));
}

class WalkedPicture : public gpu::GpuTest {};

TEST_F(WalkedPicture, has_the_gain_of_curved_skin_until_its_walks_are_made) {
    Result<Scene> scene = load_built_in_scene("builtin:spheres");
    ASSERT_TRUE(scene && complete_scene(*scene));
    Result<Stage> stage = Stage::create(device(), gpu::embedded_shaders(built_in_catalog().shaders),
                                        std::make_unique<Scene>(std::move(*scene)), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    Model model = {.scene = &stage->scene(),
                   .catalog = built_in_catalog(),
                   .choices = {TechniqueChoice(built_in_technique("preintegrated")),
                               TechniqueChoice(built_in_technique("lambert"))}};
    ASSERT_TRUE(model.choices[0].values().set("gain", "links"));
    const auto draw = [&] {
        const Result<bool> drew = stage->refresh(model, 0, {48, 32}, 0);
        EXPECT_TRUE(drew && *drew);
        EXPECT_TRUE(device().finish());
        return stage->picture(0).passes;
    };
    const size_t without = draw();
    EXPECT_TRUE(stage->lacks_walks(0));
    while (stage->is_walking()) stage->take_walks();
    const size_t with = draw();
    EXPECT_FALSE(stage->lacks_walks(0));
    const size_t objects = stage->scene().objects.size();
    EXPECT_EQ(with, without + 2 * objects) << "two passes for each object of skin";
}

}  // namespace
}  // namespace dermis::view
