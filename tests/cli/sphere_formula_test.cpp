// Pictures of dermis compared with a formula in sphere_formula.py, plain Python without code of dermis.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

class SphereFormula : public testing::Test {
  protected:
    void SetUp() override {
        if (!has_program("python3")) GTEST_SKIP() << "python3 is needed to evaluate the formula";
    }

    // The captured share of what `command` draws, by the formula.
    double share_of(const std::string& command, const std::string& layer) {
        const std::string file = (directory_.path / "sphere.exr").string();
        const ProgramResult drawn =
            run_shell(std::string(DERMIS_PROGRAM) + " " + command + " -o " + file, directory_.path.string());
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        const ProgramResult result = run_shell(
            "python3 " DERMIS_SOURCE_DIR "/tests/cli/sphere_formula.py " + file + " '" + layer + "'",
            directory_.path.string());
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const auto json = nlohmann::json::parse(result.out, nullptr, false);
        EXPECT_TRUE(json.is_object()) << result.out;
        EXPECT_GT(json.value("pixels", 0), 900) << result.out;
        std::printf("%s: %s", command.c_str(), result.out.c_str());
        return json.value("captured", -1.0);
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(SphereFormula, is_what_the_reference_draws) {
    EXPECT_GT(
        share_of("reference builtin:unit --size 40x40 --filter center --specular none --ambient renderer "
                 "--penumbra-mm 0 --probes 64 --samples 64",
                 "diffuse"),
        0.97);
}

TEST_F(SphereFormula, is_what_preintegrated_draws_and_lambert_does_not) {
    const std::string picture = " --set specular=none --size 40x40 --samples 1";
    EXPECT_GT(share_of("render builtin:unit -t preintegrated --set gain=none" + picture, ""), 0.98);
    EXPECT_NEAR(share_of("render builtin:unit -t lambert" + picture, ""), 0, 0.01);
}
