// Compute passes that read and write buffers: arrays, and the vertices that later passes draw.

#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Positions at rest plus a step, written to the stream.
const std::string kMove = kHead + R"(
layout(local_size_x = 64) in;
layout(scalar) readonly buffer Rest { vec3 rest[]; };
layout(scalar) readonly buffer Step { float steps[]; };
layout(scalar) writeonly buffer Moved { vec3 moved[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < moved.length()) moved[i] = rest[i] + vec3(steps[0], 0, 0);
})";

const std::vector<float> kTriangle = {-1, -1, 0.5f, 3, -1, 0.5f, -1, 3, 0.5f};  // covers everything

class BufferPassTest : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        Result<Array> rest = Array::upload(device(), "rest", std::as_bytes(std::span(kTriangle)));
        ASSERT_TRUE(rest) << rest.error().message;
        rest_.emplace(std::move(*rest));
    }

    static Pass move_pass() {
        return {.name = "move",
                .kind = PassKind::compute,
                .shader = "move.comp",
                .threads = 3,
                .buffers = {{"Rest", "rest"}, {"Step", "step"}, {"Moved", "vertices"}}};
    }

    FrameInputs inputs(const Array& step, const Geometry& mesh) const {
        return {.width = 4,
                .height = 4,
                .buffers = {{"rest", {.array = &*rest_}},
                            {"step", {.array = &step}},
                            {"vertices", {.geometry = &mesh, .stream = "position_mm"}}},
                .draws = {draw_of(mesh, 3)}};
    }

    static Array step_of(float step) { return Array::streamed(std::as_bytes(std::span(&step, 1))); }

    std::optional<Array> rest_;
};

const Pass kDraw = {.name = "draw",
                    .kind = PassKind::geometry_screen,
                    .shader = "white.frag",
                    .colors = {{.image = "color"}},
                    .geometry = GeometryFilter::all};

}  // namespace

TEST_F(BufferPassTest, vertices_move_before_the_draws_of_the_same_frame_and_of_others) {
    const Geometry mesh = clip_mesh(device(), std::vector<float>(9, 9.0f));
    Executor mover = make_executor(basic_shaders({{"move.comp", kMove}})),
             drawer = make_executor(basic_shaders());
    const PassList draw{.images = {{.name = "color", .format = ImageFormat::rgba8}}, .passes = {kDraw}};
    PassList both = draw;
    both.passes.insert(both.passes.begin(), move_pass());
    for (const float step : {0.0f, 8.0f, 0.25f}) {
        const Array steps = step_of(step);
        run(mover, both, inputs(steps, mesh));
        const float expected = step < 8 ? 1.0f : 0.0f;  // a step of 8 leaves the picture
        EXPECT_THAT(texel(read(mover, "color"), 3, 3), Each(expected)) << step;
        run(drawer, draw, inputs(steps, mesh));
        EXPECT_THAT(texel(read(drawer, "color"), 3, 3), Each(expected)) << step;
        const Result<std::vector<float>> moved = mesh.read(device(), "position_mm");
        ASSERT_TRUE(moved) << moved.error().message;
        EXPECT_THAT(*moved, ElementsAre(step - 1, -1, 0.5f, step + 3, -1, 0.5f, step - 1, 3, 0.5f));
    }
}

TEST_F(BufferPassTest, more_buffers_than_the_device_binds_are_an_error) {
    for (const int most : {3, 2}) {
        Result<Device> small = Device::create({.validation = true, .most_storage_buffers = most});
        ASSERT_TRUE(small) << small.error().message;
        Result<Array> rest = Array::upload(*small, "rest", std::as_bytes(std::span(kTriangle)));
        ASSERT_TRUE(rest) << rest.error().message;
        const Geometry mesh = clip_mesh(*small, kTriangle);
        const Array step = step_of(1);
        FrameInputs frame = inputs(step, mesh);
        frame.buffers["rest"].array = &*rest;
        Result<Executor> executor = Executor::create(*small, basic_shaders({{"move.comp", kMove}}));
        ASSERT_TRUE(executor) << executor.error().message;
        const Result<FrameResult> result = executor->run({.passes = {move_pass()}}, frame);
        EXPECT_EQ(bool(result), most == 3);
        if (!result) EXPECT_THAT(result.error().message, HasSubstr("binds 3 storage buffers"));
    }
}

TEST_F(BufferPassTest, mistakes_name_the_buffer) {
    const Geometry mesh = clip_mesh(device(), kTriangle);
    const Array step = step_of(1);
    Executor executor = make_executor(basic_shaders({{"move.comp", kMove}}));
    const auto error = [&](Pass pass, const FrameInputs& frame) {
        const Result<FrameResult> result = executor.run({.passes = {std::move(pass)}}, frame);
        return result ? std::string() : result.error().message;
    };
    const FrameInputs good = inputs(step, mesh);
    EXPECT_EQ(error(move_pass(), good), "");

    Pass pass = move_pass();
    pass.buffers[2].image = "nothing";
    EXPECT_THAT(error(pass, good), HasSubstr("nothing supplies the buffer 'nothing'"));
    pass.buffers[2].image = "step";
    EXPECT_THAT(error(pass, good), HasSubstr("goes along with the frame; declare it readonly"));
    pass.buffers.pop_back();
    EXPECT_THAT(error(pass, good), HasSubstr("'Moved' must be declared readonly"));
    pass = move_pass();
    pass.threads = 0;
    EXPECT_THAT(error(pass, good), HasSubstr("needs a storage image, or buffers and threads"));

    FrameInputs other = inputs(step, mesh);
    other.buffers["vertices"].stream = "uv";
    EXPECT_THAT(error(move_pass(), other), HasSubstr("the geometry lacks the stream 'uv'"));
    EXPECT_FALSE(mesh.read(device(), "uv"));
}

}  // namespace dermis::gpu
