// Frames that the CPU does not wait for.

#include "dermis/gpu/executor_state.h"
#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::ElementsAre;

class FramesInFlightTest : public GpuTest {};

// sum = 10 sum + a uniform + a push constant, slowly: the CPU has written the next frames' values long before
// the device reads this one's.
const std::string kSlowDigit = kHead + R"(
uniform texture2D source;
uniform sampler nearest_clamp;
layout(scalar) uniform Digits { float digit; };
layout(push_constant, scalar) uniform Push { float zero; };
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() {
    vec4 sum = texture(sampler2D(source, nearest_clamp), uv);
    float slow = uv.x;
    for (int i = 0; i < 2000; ++i) slow = sin(slow + uv.y);
    color = sum * 10 + digit + zero + (slow > 2 ? 1 : 0);
})";

PassList digit_list() {
    return {
        .images = {{.name = "out", .format = ImageFormat::rgba32f},
                   {.name = "sum", .format = ImageFormat::rgba32f, .persistent = true}},
        .passes = {{.name = "digit",
                    .shader = "slow_digit.frag",
                    .reads = {{"source", "sum"}},
                    .colors = {{.image = "out"}},
                    .values = {{"zero", 0.0f}}},
                   {.name = "keep", .kind = PassKind::copy, .reads = {"out"}, .colors = {{.image = "sum"}}}}};
}

FrameInputs digit_inputs(int digit) {
    FrameInputs inputs = {.width = 32, .height = 32};
    inputs.blocks["Digits"]["digit"] = float(digit);
    return inputs;
}

const std::string kOffsetMesh = kHead + R"(
layout(location = 0) in vec3 position_mm;
void main() { gl_Position = vec4(position_mm, 1); })";

// A triangle over the left or the right half.
Geometry streamed_half(bool right) {
    const float x = right ? 0 : -1;
    const std::vector<float> positions = {x,     -3, 0, x + 1, -3, 0, x, 3, 0,
                                          x + 1, -3, 0, x + 1, 3,  0, x, 3, 0};
    const uint32_t indices[] = {0, 1, 2, 3, 4, 5};
    const VertexStream stream{"position_mm", 3, positions};
    Result<Geometry> mesh = Geometry::streamed("half", std::span(&stream, 1), indices);
    EXPECT_TRUE(mesh) << mesh.error().message;
    return std::move(*mesh);
}

}  // namespace

TEST_F(FramesInFlightTest, each_frame_reads_its_own_values) {
    Executor executor = make_executor(basic_shaders({{"slow_digit.frag", kSlowDigit}}));
    for (int digit = 1; digit <= 6; ++digit) ASSERT_TRUE(executor.submit(digit_list(), digit_inputs(digit)));
    EXPECT_THAT(texel(read(executor, "sum"), 7, 20), ElementsAre(123456, 123456, 123456, 123456));
}

TEST_F(FramesInFlightTest, every_frame_has_its_times_once_and_in_order) {
    Executor executor = make_executor(basic_shaders({{"slow_digit.frag", kSlowDigit}}));
    std::vector<uint64_t> submitted, finished;
    const auto take = [&] {
        const Result<std::vector<FrameResult>> results = executor.finished();
        ASSERT_TRUE(results) << results.error().message;
        for (const FrameResult& result : *results) {
            finished.push_back(result.frame);
            ASSERT_EQ(result.passes.size(), 2u);
            EXPECT_EQ(result.passes[0].name, "digit");
            EXPECT_EQ(result.passes[0].samples_passed, 32u * 32u);
            EXPECT_GT(result.passes[0].time_ms, 0);
        }
    };
    for (int digit = 1; digit <= 5; ++digit) {
        const Result<uint64_t> frame = executor.submit(digit_list(), digit_inputs(digit));
        ASSERT_TRUE(frame) << frame.error().message;
        submitted.push_back(*frame);
        if (digit % 2) take();
    }
    ASSERT_TRUE(device().finish());
    take();
    EXPECT_EQ(finished, submitted);
}

TEST_F(FramesInFlightTest, a_frame_that_is_waited_for_has_its_own_times_and_leaves_those_before) {
    Executor executor = make_executor(basic_shaders({{"slow_digit.frag", kSlowDigit}}));
    ASSERT_TRUE(executor.submit(digit_list(), digit_inputs(1)));
    const FrameResult waited = run(executor, digit_list(), digit_inputs(2));
    EXPECT_EQ(waited.frame, 2u);
    const Result<std::vector<FrameResult>> before = executor.finished();
    ASSERT_TRUE(before);
    ASSERT_EQ(before->size(), 1u);
    EXPECT_EQ(before->front().frame, 1u);
}

TEST_F(FramesInFlightTest, what_a_frame_reads_may_be_destroyed_after_it_was_submitted) {
    Executor executor = make_executor(basic_shaders({{"slow_digit.frag", kSlowDigit}}));
    {
        Executor source = make_executor(basic_shaders());
        ASSERT_TRUE(source.submit({.images = {{.name = "clear", .format = ImageFormat::rgba32f}},
                                   .passes = {clear_pass("clear", {4, 4, 4, 4})}},
                                  {.width = 32, .height = 32}));
        PassList list = digit_list();
        list.images.pop_back();
        list.passes.pop_back();
        list.passes[0].reads.clear();
        FrameInputs inputs = digit_inputs(2);
        inputs.images["source"] = {.executor = &source, .name = "clear"};
        ASSERT_TRUE(executor.submit(list, inputs));
    }
    EXPECT_THAT(texel(read(executor, "out"), 1, 1), ElementsAre(42, 42, 42, 42));
}

TEST_F(FramesInFlightTest, streamed_geometry_is_that_of_its_frame) {
    Executor executor = make_executor(basic_shaders({{"offset.vert", kOffsetMesh}}));
    const PassList list = {.images = {{.name = "out", .format = ImageFormat::rgba32f, .persistent = true}},
                           .passes = {{.name = "half",
                                       .kind = PassKind::geometry_screen,
                                       .shader = "white.frag",
                                       .vertex_shader = "offset.vert",
                                       .colors = {{.image = "out", .load = LoadOp::load}},
                                       .geometry = GeometryFilter::all}}};
    for (const bool right : {false, true}) {
        const Geometry half = streamed_half(right);
        ASSERT_TRUE(executor.submit(list, {.width = 8, .height = 2, .draws = {draw_of(half, 6)}}));
    }
    const Image out = read(executor, "out");
    for (int x = 0; x < 8; ++x) EXPECT_EQ(texel(out, x, 1)[0], 1) << x;
}

TEST_F(FramesInFlightTest, the_same_frame_makes_no_vulkan_object_after_the_first_ones) {
    Executor executor = make_executor(basic_shaders({{"slow_digit.frag", kSlowDigit}}));
    for (size_t i = 0; i < kFramesInFlight; ++i) ASSERT_TRUE(executor.submit(digit_list(), digit_inputs(1)));
    const uint64_t before = device().created_objects();
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(executor.submit(digit_list(), digit_inputs(i % 10)));
    EXPECT_EQ(device().created_objects(), before);
    FrameInputs larger = digit_inputs(1);
    larger.width = 33;
    ASSERT_TRUE(executor.submit(digit_list(), larger));
    EXPECT_GT(device().created_objects(), before);
}

}  // namespace dermis::gpu
