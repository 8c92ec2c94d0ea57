#pragma once
// A small picture and its parts.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "dermis/jobs/part.h"
#include "reference/shapes.h"
#include "support/temporary_directory.h"

namespace dermis::test {

inline constexpr int kPartSamples = 28;

/// A sphere of 5 mm in front of a background, lit from one side.
inline Scene lit_sphere() {
    Scene scene;
    scene.objects.push_back({.name = "sphere", .mesh = sphere(5, 3), .classes = {MaterialClass::skin}});
    scene.lights.push_back({.intensity = 3, .to_light_world = normalize(Vec3{1, 0.5f, 1}), .is_key = true});
    scene.camera = {.eye_mm = {0, 0, 40}, .vertical_fov_rad = 0.3f, .near_mm = 1, .far_mm = 100};
    scene.environment.kind = EnvironmentKind::none;
    scene.background_linear = {0.3f, 0.5f, 0.75f};
    return scene;
}

inline ReferenceSettings part_settings() {
    return {.width = 11, .height = 9, .samples = kPartSamples, .probes = 6};
}

inline PartFacts part_facts(SampleRange range) {
    return {.picture = {.description = R"({"scene":"sphere","passes":null,"seed":1})",
                        .credit = "made here",
                        .scene_warnings = {"a warning"},
                        .tone_map = ToneMap::aces,
                        .exposure_ev = 0.3f},
            .version = "v1",
            .content = "c1",
            .command = "dermis reference sphere --samples 28",
            .range = range,
            .samples = kPartSamples};
}

/// Writes parts, each named after its range.
class PartFiles {
  public:
    std::filesystem::path write(SampleRange range, const PartFacts& facts) {
        const Result<PictureSums> sums = sum_samples(lit_sphere(), part_settings(), range);
        EXPECT_TRUE(sums) << sums.error().message;
        const std::filesystem::path file =
            path("part_" + std::to_string(range.begin) + "_" + std::to_string(range.end) + ".exr");
        const Result<void> written = write_part(file, facts, *sums);
        EXPECT_TRUE(written) << written.error().message;
        return file;
    }
    std::filesystem::path write(SampleRange range) { return write(range, part_facts(range)); }
    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return directory_.path / name; }

  private:
    TemporaryDirectory directory_;
};

}  // namespace dermis::test
