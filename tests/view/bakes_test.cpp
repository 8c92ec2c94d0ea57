// A new scene is shown before it is baked.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/render/complete_scene.h"
#include "dermis/view/loader.h"
#include "dermis/view/stage.h"
#include "support/built_in.h"
#include "support/gpu_fixture.h"
#include "support/temporary_directory.h"

namespace dermis::view {
namespace {

Start loaded(Loader& loader) {
    loader.wait();
    std::optional<Result<Start>> start = loader.take();
    EXPECT_TRUE(start && *start);
    return start && *start ? std::move(**start) : Start{};
}

TEST(Loader, brings_a_new_scene_without_its_bakes_and_then_these) {
    TemporaryDirectory directory;
    const std::string path = (directory.path / "sheet.obj").string();
    ASSERT_TRUE(write_text_file(path, "v 0 0 0\nv 100 0 0\nv 0 100 0\nf 1 2 3\n"));
    Loader loader({}, "", built_in_catalog().subjects);
    ASSERT_TRUE(loader.load(path, {}, Load::scene));
    EXPECT_FALSE(loader.load(path, {}, Load::pose));
    const Start first = loaded(loader);
    EXPECT_TRUE(first.lacks_bakes);
    ASSERT_EQ(first.scene.objects.size(), 1u);
    EXPECT_THAT(first.scene.objects[0].mesh.occlusions, testing::IsEmpty());

    loader.complete(first.scene);
    EXPECT_EQ(loader.what(), Load::bakes);
    for (const Load again : {Load::bakes, Load::same_scene, Load::pose}) {
        if (again != Load::bakes) ASSERT_TRUE(loader.load(path, {}, again));
        const Start whole = loaded(loader);
        EXPECT_FALSE(whole.lacks_bakes);
        ASSERT_EQ(whole.scene.objects.size(), 1u);
        EXPECT_EQ(whole.scene.objects[0].mesh.occlusions.size(), 3u);
        EXPECT_EQ(whole.scene.objects[0].mesh.curvatures_per_mm.size(), 3u);
    }
}

class Bakes : public gpu::GpuTest {};

TEST_F(Bakes, are_awaited_with_a_picture_without_scattering) {
    const std::span<const Technique> techniques = built_in_catalog().techniques;
    Result<Scene> scene = load_built_in_scene("builtin:spheres");
    ASSERT_TRUE(scene) << scene.error().message;
    Scene whole = *scene;
    ASSERT_TRUE(complete_scene(whole));
    Result<Stage> stage = Stage::create(device(), gpu::embedded_shaders(built_in_catalog().shaders),
                                        std::make_unique<Scene>(std::move(*scene)), 4);
    ASSERT_TRUE(stage) << stage.error().message;
    Model model = {.scene = &stage->scene(),
                   .catalog = built_in_catalog(),
                   .choices = {TechniqueChoice(built_in_technique("screen_space_burley")),
                               TechniqueChoice(techniques[0])}};
    const auto draw_to_the_end = [&](double from_s) {
        for (double now_s = from_s; now_s < from_s + 20 && !stage->is_final(0); now_s += 1) {
            const Result<bool> drew = stage->refresh(model, 0, {48, 32}, now_s);
            EXPECT_TRUE(drew) << drew.error().message;
            EXPECT_TRUE(device().finish());
            EXPECT_TRUE(stage->take_times(0));
        }
        EXPECT_TRUE(stage->is_final(0));
        return stage->picture(0);
    };
    stage->await_bakes(built_in_technique("lambert"));
    const Picture first = draw_to_the_end(0);
    EXPECT_EQ(first.quality.samples, 1);
    ASSERT_TRUE(stage->replace_objects(std::move(whole)));
    EXPECT_FALSE(stage->lacks_bakes());
    EXPECT_FALSE(stage->is_final(0));
    const Picture last = draw_to_the_end(100);
    EXPECT_EQ(last.quality.samples, 4);
    EXPECT_GT(last.passes, first.passes + 1);
}

TEST(Progress, of_the_work_that_began_last_is_current) {
    EXPECT_EQ(current_progress(), "");
    Progress outer("maps", 4);
    outer.advance();
    {
        Progress inner("rays", 2);
        inner.set(0.1, "walks");
        inner.set(0.5);
        EXPECT_THAT(current_progress(), testing::StartsWith("walks  50 %"));
    }
    EXPECT_THAT(current_progress(), testing::StartsWith("maps  25 %"));
}

}  // namespace
}  // namespace dermis::view
