// What a window needs beside a scene's passes: pictures of another executor, and draws cut to a rectangle.

#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::HasSubstr;

class WindowSideTest : public GpuTest {};

PassList copy_of_picture() {
    return {.images = {{.name = "out", .format = ImageFormat::rgba32f}},
            .passes = {{.name = "copy",
                        .shader = "scaled.frag",
                        .reads = {{"source", "picture"}},
                        .colors = {{.image = "out"}},
                        .values = {{"scale", 0.5f}}}}};
}

TEST_F(WindowSideTest, a_pass_reads_an_image_of_another_executor_again_and_again) {
    Executor scene = make_executor(basic_shaders()), window = make_executor(basic_shaders());
    for (const float red : {1.0f, 0.25f}) {
        run(scene,
            {.images = {{.name = "display", .format = ImageFormat::rgba32f}},
             .passes = {clear_pass("display", {red, 0, 0, 1})}},
            {.width = 3, .height = 2});
        for (int frame = 0; frame < 2; ++frame) {
            run(window, copy_of_picture(),
                {.width = 4, .height = 4, .images = {{"picture", {&scene, "display"}}}});
            EXPECT_EQ(read(window, "out").at(3, 3, 0), red / 2);
        }
    }
}

TEST_F(WindowSideTest, an_image_the_other_executor_lacks_is_an_error) {
    Executor scene = make_executor(basic_shaders()), window = make_executor(basic_shaders());
    const Result<FrameResult> result = window.run(
        copy_of_picture(), {.width = 4, .height = 4, .images = {{"picture", {&scene, "display"}}}});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("'source'"));
}

TEST_F(WindowSideTest, a_scissor_cuts_its_draw_and_no_other) {
    Executor executor = make_executor(basic_shaders());
    const Geometry mesh = clip_mesh(device(), {-1, -1, 0, -1, 3, 0, 3, -1, 0});
    const Pass white{.name = "white",
                     .kind = PassKind::geometry_screen,
                     .shader = "white.frag",
                     .colors = {{.image = "out"}}};
    const PassList list{.images = {{.name = "out"}}, .passes = {white}};
    Draw cut = draw_of(mesh, 3);
    const auto covered = [&](std::vector<Draw> draws) {
        return run(executor, list, {.width = 8, .height = 8, .draws = std::move(draws)})
            .passes[0]
            .samples_passed;
    };
    cut.scissor = PixelRect{.x = 2, .y = 1, .width = 3, .height = 2};
    EXPECT_EQ(covered({cut}), 6u);
    EXPECT_EQ(read(executor, "out").at(2, 1, 0), 1);
    EXPECT_EQ(read(executor, "out").at(1, 1, 0), 0);
    EXPECT_EQ(covered({cut, draw_of(mesh, 3)}), 6u + 64u);
    cut.scissor = PixelRect{.x = -5, .y = 6, .width = 100, .height = 100};
    EXPECT_EQ(covered({cut}), 16u);
    cut.scissor = PixelRect{.x = 20, .y = 20, .width = 5, .height = 5};
    EXPECT_EQ(covered({cut}), 0u);
}

}  // namespace
}  // namespace dermis::gpu
