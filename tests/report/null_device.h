#pragma once
// For tests that compile for a chip: one device without hardware. They are skipped where RADV is not
// installed, and fail where it is and does not open.

#include <gtest/gtest.h>

#include <optional>

#include "dermis/gpu/statistics.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/render/shared_passes.h"
#include "support/built_in.h"

namespace dermis {

class NullDeviceTest : public ::testing::Test {
  protected:
    static constexpr std::string_view kChip = "navi21";

    void SetUp() override {
        Result<gpu::NullDevice> opened = gpu::NullDevice::open(kChip, shaders());
        if (!opened && opened.error().message.find("is not installed") != std::string::npos)
            GTEST_SKIP() << opened.error().message;
        ASSERT_TRUE(opened) << opened.error().message;
        device_ = std::move(*opened);
    }

    static gpu::ShaderSource shaders() { return gpu::embedded_shaders(built_in_catalog().shaders); }

    /// With its defaults, for a scene with one light and nothing but skin of `gpu_gems_3`, which has every
    /// map.
    static PassList frame_of(const std::string& technique) {
        const Technique& found = built_in_technique(technique);
        const FrameContext frame = {.skin_gaussians = to_gaussian_sum(*find_profile("gpu_gems_3")).sum};
        PassList list = frame_passes(found.build(ParameterValues(found.parameters), frame), {});
        list.constants = {{"one_light", 1}, {"all_directional", 1}};
        return list;
    }

    std::vector<gpu::PassStatistics> compile(const PassList& list) {
        auto passes = device_->compile(list);
        EXPECT_TRUE(passes) << passes.error().message;
        return passes ? std::move(*passes) : std::vector<gpu::PassStatistics>{};
    }

    std::string driver() const { return device_->info().driver; }

  private:
    std::optional<gpu::NullDevice> device_;
};

}  // namespace dermis
