// dermis info, as text and as JSON.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

class Info : public testing::Test {
  protected:
    // A square of 200 mm in two triangles on the unit square, with a map that is there and one that is not.
    void SetUp() override {
        write("square.obj",
              "mtllib square.mtl\nv 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
              "usemtl skin\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
        write("square.mtl", "newmtl skin\nmap_Kd here.png\nmap_Bump gone.png\n");
        write("here.png", "");
    }
    void write(const std::string& name, const std::string& text) {
        std::ofstream(directory_.path / name) << text;
    }
    ProgramResult info(const std::string& arguments) {
        return run_shell("cd " + directory_.path.string() + " && " + DERMIS_PROGRAM + " info " + arguments,
                         directory_.path.string());
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(Info, json_gives_counts_box_uvs_maps_and_warnings) {
    const ProgramResult result = info("square.obj --unit-mm 10 --json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const nlohmann::json json = nlohmann::json::parse(result.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << result.out;
    EXPECT_EQ(json["triangles"], 2);
    EXPECT_EQ(json["vertices"], 4);
    EXPECT_EQ(json["high_mm"], (std::vector<double>{200, 200, 0}));
    const nlohmann::json& material = json["materials"][0];
    EXPECT_NEAR(material["uv"]["coverage"], 1, 0.01);
    EXPECT_NEAR(material["uv"]["overlap"], 0, 1e-6);
    EXPECT_NEAR(material["uv"]["mm_per_texel_2048"]["p50"], 200.0 / 2048, 1e-3);
    EXPECT_NEAR(material["uv"]["anisotropy"]["p95"], 1, 1e-3);
    ASSERT_EQ(material["maps"].size(), 2u) << result.out;
    EXPECT_EQ(material["maps"][0]["state"], "found");
    EXPECT_EQ(material["maps"][1]["state"], "missing");
    EXPECT_TRUE(json["warnings"].empty()) << result.out;
}

TEST_F(Info, a_head_of_the_wrong_size_is_warned_of) {
    const ProgramResult result = info("square.obj");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("warning: square.obj: 20 mm tall; a head is 150 to 500 mm"));
}

TEST_F(Info, built_in_meshes_are_meshes) {
    const ProgramResult result = info("builtin:spheres");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("sphere_16mm"));
    EXPECT_THAT(info("builtin:bust").out, HasSubstr("albedo (made by code)\n"));
    const ProgramResult wrong = info("builtin:sphere");
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, HasSubstr("did you mean 'spheres'?"));
}

TEST_F(Info, a_file_that_is_not_there_is_one_line) {
    const ProgramResult result = info("none.obj");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("none.obj"));
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
}

TEST_F(Info, scenes_are_told_by_name_and_by_file) {
    const ProgramResult named = info("spheres");
    EXPECT_EQ(named.exit_code, 0) << named.err;
    EXPECT_THAT(named.out, HasSubstr("sphere_16mm"));
    const ProgramResult wrong = info("spheers");
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, HasSubstr("did you mean 'spheres'?"));
}
