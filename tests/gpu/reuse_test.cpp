// What is kept from run to run and what is not; memory does not grow.

#include "test_shaders.h"

namespace dermis::gpu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ReuseTest : public GpuTest {};

/// out = source * scale, then kept in `history`.
PassList history_list() {
    return {
        .images = {{.name = "out", .format = ImageFormat::rgba32f},
                   {.name = "history", .format = ImageFormat::rgba32f, .persistent = true}},
        .passes = {
            {.name = "add one",
             .shader = "add_one.frag",
             .reads = {{"source", "history"}},
             .colors = {{.image = "out"}}},
            {.name = "keep", .kind = PassKind::copy, .reads = {"out"}, .colors = {{.image = "history"}}}}};
}

ShaderSource history_shaders() {
    return basic_shaders({{"add_one.frag", kHead + R"(
uniform texture2D source;
uniform sampler nearest_clamp;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = texture(sampler2D(source, nearest_clamp), uv) + vec4(1, 2, 3, 4); })"}});
}

TEST_F(ReuseTest, a_persistent_image_starts_at_zero_and_keeps_its_content) {
    Executor executor = make_executor(history_shaders());
    for (int frame = 1; frame <= 3; ++frame) {
        run(executor, history_list(), {.width = 2, .height = 2});
        const auto f = float(frame);
        EXPECT_THAT(texel(read(executor, "history"), 1, 1), ElementsAre(f, 2 * f, 3 * f, 4 * f));
    }
}

TEST_F(ReuseTest, another_size_clears_a_persistent_image) {
    Executor executor = make_executor(history_shaders());
    run(executor, history_list(), {.width = 2, .height = 2});
    run(executor, history_list(), {.width = 3, .height = 2});
    EXPECT_THAT(texel(read(executor, "history"), 2, 1), ElementsAre(1, 2, 3, 4));
}

TEST_F(ReuseTest, the_same_list_builds_nothing_twice) {
    Executor executor = make_executor(history_shaders());
    run(executor, history_list(), {.width = 4, .height = 4});
    const Footprint first = executor.footprint();
    run(executor, history_list(), {.width = 4, .height = 4});
    EXPECT_GE(first.pipelines, 1u);
    EXPECT_EQ(executor.footprint().pipelines, first.pipelines);
    EXPECT_EQ(executor.footprint().images, 2u);
    EXPECT_EQ(executor.footprint().image_bytes, 2u * 16 * 16);
}

TEST_F(ReuseTest, hundreds_of_runs_with_changing_lists_and_sizes_hold_no_more_than_a_few) {
    Executor executor = make_executor(history_shaders());
    const size_t pipelines_before = executor.footprint().pipelines;  // of other tests of this device
    size_t most_images = 0, most_pipelines = 0;
    for (int frame = 0; frame < 200; ++frame) {
        PassList other{.images = {{.name = "out", .format = ImageFormat::r8}},
                       .passes = {clear_pass("out", {1, 0, 0, 0})}};
        run(executor, frame % 2 ? history_list() : other, {.width = 2 + frame / 4, .height = 2});
        most_images = std::max(most_images, executor.footprint().images);
        most_pipelines = std::max(most_pipelines, executor.footprint().pipelines);
    }
    EXPECT_LE(most_images, 16u);
    EXPECT_LE(most_pipelines, pipelines_before + 1);
}

// The pipelines of a device that keeps few.
class KeptPipelinesTest : public ::testing::Test {
  protected:
    void SetUp() override {
        Result<Device> made = Device::create({.validation = true, .most_pipelines = 4});
        ASSERT_TRUE(made) << made.error().message;
        few_ = std::make_unique<Device>(std::move(*made));
    }
    void TearDown() override {
        if (few_) EXPECT_THAT(few_->messages(), ::testing::IsEmpty());
    }
    Executor executor_of_few() {
        const std::string shader = kHead + R"(
layout(constant_id = 0) const int kNumber = 0;
layout(location = 0) out vec4 color;
void main() { color = vec4(kNumber); })";
        Result<Executor> executor = Executor::create(*few_, basic_shaders({{"number.frag", shader}}));
        EXPECT_TRUE(executor) << executor.error().message;
        return std::move(*executor);
    }
    /// Each number has a pipeline.
    static void draw(Executor& executor, int number) {
        const PassList list{.images = {{.name = "out", .format = ImageFormat::rgba32f}},
                            .passes = {{.name = "number",
                                        .shader = "number.frag",
                                        .colors = {{.image = "out"}},
                                        .constants = {{"kNumber", number}}}}};
        ASSERT_TRUE(executor.run(list, {.width = 1, .height = 1}));
    }
    std::unique_ptr<Device> few_;
};

TEST_F(KeptPipelinesTest, those_that_were_idle_longest_are_destroyed) {
    Executor executor = executor_of_few();
    for (int number = 0; number < 40; ++number) draw(executor, number);
    EXPECT_LE(executor.footprint().pipelines, 9u);
    const uint64_t objects = few_->created_objects();
    draw(executor, 39);
    EXPECT_EQ(few_->created_objects(), objects);
    draw(executor, 0);
    EXPECT_GT(few_->created_objects(), objects);
}

TEST_F(KeptPipelinesTest, more_than_their_number_stay_while_executors_use_them_in_turn) {
    Executor first = executor_of_few(), second = executor_of_few();
    uint64_t objects = 0;
    for (int turn = 0; turn < 5; ++turn) {
        for (int number = 0; number < 3; ++number) {
            draw(first, number);
            draw(second, 3 + number);
        }
        if (turn == 0) objects = few_->created_objects();
    }
    EXPECT_EQ(few_->created_objects(), objects);
    EXPECT_EQ(first.footprint().pipelines, 6u);
}

TEST_F(ReuseTest, results_are_identical_from_run_to_run) {
    const std::string noise = kHead + R"(
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;
void main() { color = vec4(fract(sin(uv * 91.7) * 43758.5), sqrt(uv)); })";
    Executor executor = make_executor(basic_shaders({{"noise.frag", noise}}));
    const PassList list{.images = {{.name = "out", .format = ImageFormat::rgba32f}},
                        .passes = {{.name = "noise", .shader = "noise.frag", .colors = {{.image = "out"}}}}};
    run(executor, list, {.width = 64, .height = 64});
    const Image first = read(executor, "out");
    run(executor, list, {.width = 64, .height = 64});
    EXPECT_EQ(first.bytes, read(executor, "out").bytes);
    EXPECT_NE(texel(first, 3, 5), texel(first, 40, 50));
}

TEST_F(ReuseTest, every_pass_has_one_timing_in_order) {
    Executor executor = make_executor(history_shaders());
    const FrameResult result = run(executor, history_list(), {.width = 64, .height = 64});
    ASSERT_EQ(result.passes.size(), 2u);
    EXPECT_EQ(result.passes[0].name, "add one");
    EXPECT_EQ(result.passes[1].name, "keep");
    double sum = 0;
    for (const PassTiming& pass : result.passes) {
        EXPECT_GT(pass.time_ms, 0) << pass.name;
        sum += pass.time_ms;
    }
    EXPECT_NEAR(result.frame_ms, sum, 1e-6);
    EXPECT_EQ(result.passes[0].samples_passed, 64u * 64u);
}

TEST_F(ReuseTest, a_list_with_a_problem_is_refused_and_the_next_one_runs) {
    Executor executor = make_executor(history_shaders());
    PassList wrong = history_list();
    wrong.passes[0].reads[0].image = "nowhere";
    const Result<FrameResult> result = executor.run(wrong, {.width = 2, .height = 2});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("pass 'add one' reads 'nowhere', which nothing supplies"));
    run(executor, history_list(), {.width = 2, .height = 2});
}

TEST_F(ReuseTest, an_image_beyond_the_device_is_an_error) {
    Executor executor = make_executor(basic_shaders());
    const PassList list{.images = {{.name = "huge", .size = {1 << 20, 1 << 20}}},
                        .passes = {clear_pass("huge", {})}};
    const Result<FrameResult> result = executor.run(list, {.width = 1, .height = 1});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("'huge'"));
}

}  // namespace
}  // namespace dermis::gpu
