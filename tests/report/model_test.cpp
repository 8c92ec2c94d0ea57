// The model's arithmetic, on frames made by hand.

#include "dermis/report/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dermis;
using testing::HasSubstr;

namespace {

// 2 SIMDs at 1 GHz: 2e6 SIMD cycles a millisecond; 1e6 bytes a millisecond.
constexpr Card kCard = {.clock_ghz = 1, .compute_units = 1, .simds_per_unit = 2, .bandwidth_gb_s = 1};

gpu::ShaderStatistics shader(const char* stage, uint64_t cycles) {
    return {.stage = stage, .inverse_throughput_cycles = cycles};
}

// A full-screen pass over 100 x 100 pixels that reads an image of its own size and a map.
FrameWork fullscreen_work() {
    FrameWork work = {.width = 100, .height = 100};
    work.list.images = {{.name = "in", .format = ImageFormat::rgba16f},
                        {.name = "out", .format = ImageFormat::rgba8},
                        {.name = "table", .format = ImageFormat::rgba8, .size = {16, 16}}};
    work.list.passes = {{.name = "blur", .shader = "a.frag", .reads = {"in"}, .colors = {{.image = "out"}}}};
    work.passes = {{.pass = "blur", .vertices = 3, .fragments = 6400}};
    return work;
}

}  // namespace

TEST(CostModel, arithmetic_is_cycles_for_each_64_runs_over_all_simds) {
    const FrameWork work = fullscreen_work();
    const FrameCost cost = model_frame(
        work, {{.pass = "blur", .shaders = {shader("vertex", 64), shader("fragment", 2000)}}}, kCard);
    ASSERT_EQ(cost.passes.size(), 1u);
    EXPECT_NEAR(cost.passes[0].shaders[0].arithmetic_ms, 3.0 / 64 * 64 / 2e6, 1e-12);
    EXPECT_NEAR(cost.passes[0].shaders[1].arithmetic_ms, 6400.0 / 64 * 2000 / 2e6, 1e-12);
    EXPECT_NEAR(cost.passes[0].arithmetic_ms, 0.1000015, 1e-9);
}

TEST(CostModel, a_pass_writes_its_fragments_and_reads_an_image_of_its_size_where_it_covers_it) {
    const FrameWork work = fullscreen_work();
    EXPECT_EQ(bytes_moved(work, 0, {.pass = "blur"}), 6400u * 4 + 6400u * 8);
}

TEST(CostModel, an_image_of_another_size_is_read_whole_and_once) {
    FrameWork work = fullscreen_work();
    work.list.passes[0].reads = {{"a", "table"}, {"b", "table"}};
    EXPECT_EQ(bytes_moved(work, 0, {.pass = "blur", .textures = {"a", "b"}}), 6400u * 4 + 16 * 16 * 4);
}

TEST(CostModel, blending_and_depth_are_read_as_well_as_written) {
    FrameWork work = fullscreen_work();
    work.list.images.push_back({.name = "z", .format = ImageFormat::depth32f});
    Pass& pass = work.list.passes[0];
    pass.reads.clear();
    pass.colors[0].blend = Blend::additive;
    pass.depth = DepthTarget{.image = "z", .write = false};
    EXPECT_EQ(bytes_moved(work, 0, {}), 6400u * (2 * 4 + 4));
    pass.depth->write = true;
    EXPECT_EQ(bytes_moved(work, 0, {}), 6400u * (2 * 4 + 2 * 4));
}

TEST(CostModel, a_map_is_read_a_texel_for_each_fragment_and_no_more_than_its_size) {
    FrameWork work = fullscreen_work();
    work.list.passes[0].reads.clear();
    work.passes[0].textures = {{"large", {1 << 30, 4}}, {"small", {100, 4}}, {"not_bound", {1 << 30, 4}}};
    EXPECT_EQ(bytes_moved(work, 0, {.textures = {"large", "small"}}), 6400u * 4 + 6400u * 4 + 100u);
}

TEST(CostModel, geometry_reads_each_vertex_and_index_once) {
    FrameWork work = fullscreen_work();
    work.list.passes[0].reads.clear();
    work.passes[0] = {.pass = "skin", .vertices = 50, .indices = 240, .fragments = 0};
    EXPECT_EQ(bytes_moved(work, 0, {.vertex_bytes = 24}), 50u * 24 + 240u * 4);
}

TEST(CostModel, the_larger_bound_counts_and_passes_add_up) {
    FrameWork work = fullscreen_work();
    work.list.passes.push_back(work.list.passes[0]);
    work.passes.push_back(work.passes[0]);
    const FrameCost cost = model_frame(
        work, {{.shaders = {shader("fragment", 2)}}, {.shaders = {shader("fragment", 20000)}}}, kCard);
    const double bandwidth_ms = 6400.0 * 12 / 1e6;
    EXPECT_NEAR(cost.passes[0].model_ms(), bandwidth_ms, 1e-9);
    EXPECT_NEAR(cost.passes[1].model_ms(), 1.0, 1e-9);
    EXPECT_NEAR(cost.model_ms(), 1.0 + bandwidth_ms, 1e-9);
}

TEST(CostModel, an_unknown_chip_is_named_with_the_known_ones) {
    const auto card = find_card("navi22");
    ASSERT_FALSE(card);
    EXPECT_THAT(card.error().message, HasSubstr("did you mean 'navi21'"));
    EXPECT_THAT(card.error().message, HasSubstr("vega10"));
}
