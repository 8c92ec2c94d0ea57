// What the compiler of an AMD chip makes of the techniques, on a machine that has no such chip.

#include "dermis/gpu/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "dermis/report/model.h"
#include "report/null_device.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

class CostStatistics : public NullDeviceTest {
  protected:
    gpu::ShaderStatistics skin(const std::string& technique) {
        for (const gpu::PassStatistics& pass : compile(frame_of(technique)))
            if (pass.pass == "skin") return pass.shaders.back();
        ADD_FAILURE() << technique << " has no skin pass";
        return {};
    }
};

}  // namespace

TEST_F(CostStatistics, every_pass_of_every_technique_has_statistics) {
    for (const Technique& technique : built_in_catalog().techniques) {
        const PassList list = frame_of(technique.id);
        const auto passes = compile(list);
        ASSERT_EQ(passes.size(), list.passes.size());
        for (size_t i = 0; i < passes.size(); ++i) {
            if (list.passes[i].shader.empty()) continue;
            ASSERT_FALSE(passes[i].shaders.empty()) << technique.id << ", " << passes[i].pass;
            const gpu::ShaderStatistics& shader = passes[i].shaders.back();
            EXPECT_NE(shader.stage, "vertex");
            EXPECT_GT(shader.instructions, 2u) << technique.id << ", " << passes[i].pass;
            EXPECT_GT(shader.vgprs, 0u);
            EXPECT_GT(shader.inverse_throughput_cycles, 0u);
            EXPECT_GT(shader.latency_cycles, shader.inverse_throughput_cycles / 64);
        }
    }
}

// A map of the material and the shadow map are bound in different ways; both are bytes that the pass reads.
TEST_F(CostStatistics, a_pass_lists_each_texture_that_it_reads) {
    for (const gpu::PassStatistics& pass : compile(frame_of("lambert"))) {
        if (pass.pass != "skin") continue;
        for (const char* name : {"albedo_map", "normal_map", "shadow_map"})
            EXPECT_EQ(std::ranges::count(pass.textures, name), 1) << name;
        return;
    }
    FAIL() << "lambert has no skin pass";
}

TEST_F(CostStatistics, more_work_has_more_instructions_and_cycles) {
    const gpu::ShaderStatistics lambert = skin("lambert"), preintegrated = skin("preintegrated");
    EXPECT_GT(preintegrated.instructions, lambert.instructions);
    EXPECT_GT(preintegrated.inverse_throughput_cycles, lambert.inverse_throughput_cycles);
}

TEST_F(CostStatistics, specialisation_constants_reach_the_compiler) {
    PassList list = frame_of("lambert");
    const uint64_t with_specular = skin("lambert").instructions;
    for (Pass& pass : list.passes)
        for (auto& [name, value] : pass.constants)
            if (name == "specular_model") value = 0;
    for (const gpu::PassStatistics& pass : compile(list))
        if (pass.pass == "skin") EXPECT_LT(pass.shaders.back().instructions, with_specular);
}

TEST_F(CostStatistics, every_card_has_a_chip_that_the_driver_compiles_for) {
    for (const Card& card : cards()) {
        auto device = gpu::NullDevice::open(card.chip, shaders());
        ASSERT_TRUE(device) << card.chip << ": " << device.error().message;
        const auto passes = device->compile(frame_of("lambert"));
        ASSERT_TRUE(passes) << passes.error().message;
        EXPECT_GT(passes->back().shaders.back().instructions, 0u) << card.chip;
    }
}

TEST_F(CostStatistics, the_environment_is_as_before_when_the_device_is_open) {
    EXPECT_EQ(std::getenv("RADV_FORCE_FAMILY"), nullptr);
}

TEST_F(CostStatistics, a_device_that_draws_can_be_open_beside_it) {
    const auto drawing = gpu::Device::create({});
    ASSERT_TRUE(drawing) << drawing.error().message;
    EXPECT_NE(drawing->info().driver, driver());
    EXPECT_GT(skin("lambert").instructions, 0u);
}
