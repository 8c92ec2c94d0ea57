// The executor's passes, one kind at a time, pixel by pixel.

#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

class ExecutorTest : public GpuTest {};

TEST_F(ExecutorTest, a_pass_without_a_shader_clears) {
    Executor executor = make_executor(basic_shaders());
    const PassList list{.images = {{.name = "out", .format = ImageFormat::rgba8}},
                        .passes = {clear_pass("out", {1, 0, 0.2f, 1})}};
    const FrameResult result = run(executor, list, {.width = 5, .height = 3});
    ASSERT_EQ(result.passes.size(), 1u);
    EXPECT_EQ(result.passes[0].name, "clear out");
    const Image image = read(executor, "out");
    EXPECT_EQ(image.width, 5);
    EXPECT_EQ(image.height, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) EXPECT_THAT(texel(image, x, y), ElementsAre(1, 0, 51 / 255.f, 1));
}

// The lower left half of the picture: framebuffer y points down, as clip y does.
TEST_F(ExecutorTest, a_triangle_covers_exactly_its_pixels) {
    Executor executor = make_executor(basic_shaders());
    const Geometry mesh = clip_mesh(device(), {-1, -1, 0.5f, -1, 1, 0.5f, 1, 1, 0.5f});
    const PassList list{.images = {{.name = "out", .format = ImageFormat::r8}},
                        .passes = {{.name = "draw",
                                    .kind = PassKind::geometry_screen,
                                    .shader = "white.frag",
                                    .colors = {{.image = "out"}}}}};
    const FrameResult result = run(executor, list, {.width = 8, .height = 8, .draws = {draw_of(mesh, 3)}});
    const Image image = read(executor, "out");
    size_t covered = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            if (x != y) {
                EXPECT_EQ(image.at(x, y, 0), x < y ? 1.f : 0.f) << x << ", " << y;
            }
            covered += image.at(x, y, 0) > 0;
        }
    EXPECT_EQ(result.passes[0].samples_passed, covered);
}

}  // namespace
}  // namespace dermis::gpu
