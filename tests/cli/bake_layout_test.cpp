// Which UVs baked maps have: the file's, or an atlas that is written beside them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;
using testing::Not;

namespace {

namespace fs = std::filesystem;

// Two squares, of 100 and of 50 mm, whose UVs both are 0..1.
constexpr const char* kSharedTexels =
    "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nv 0 0 90\nv 50 0 90\nv 50 50 90\nv 0 50 90\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl skin_a\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\nusemtl skin_b\nf 5/1 6/2 7/3\nf 5/1 7/3 8/4\n";

class BakeLayout : public testing::Test {
  protected:
    void SetUp() override { std::ofstream(directory_.path / "two.obj") << kSharedTexels; }
    ProgramResult bake(const std::string& arguments) {
        return run_shell("cd " + directory_.path.string() + " && " DERMIS_PROGRAM " bake " + arguments,
                         directory_.path.string());
    }
    bool exists(const std::string& name) { return fs::exists(directory_.path / name); }
    std::string uvs_of(const std::string& sidecar) {
        const auto json = nlohmann::json::parse(slurp((directory_.path / sidecar).string()), nullptr, false);
        return json.is_object() ? json.value("uvs", "") : "";
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(BakeLayout, materials_that_share_texels_are_baked_over_an_atlas_that_comes_with_the_map) {
    const ProgramResult result = bake("stretch two.obj --size 128 -o map.exr");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("covered by more than one")));
    EXPECT_THAT(result.out, HasSubstr("laid out by an atlas"));
    EXPECT_EQ(uvs_of("map.exr.json"), "TEXCOORD_1 of map_atlas.glb");
    EXPECT_THAT(slurp((directory_.path / "map_atlas.glb").string()), HasSubstr("TEXCOORD_1"));
}

TEST_F(BakeLayout, baked_normals_too) {
    const ProgramResult result = bake("normals two.obj --size 64 -o map.exr");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("share texels")));
    EXPECT_TRUE(exists("map_atlas.glb"));
    EXPECT_EQ(uvs_of("map_red.exr.json"), "TEXCOORD_1 of map_atlas.glb");
}

TEST_F(BakeLayout, the_uvs_of_the_file_can_be_asked_for) {
    const ProgramResult shared = bake("occlusion two.obj --uvs file --size 64 -o map.exr");
    EXPECT_THAT(shared.err, HasSubstr("covered by more than one triangle"));
    EXPECT_THAT(shared.out, HasSubstr("laid out by the UVs of the file"));
    EXPECT_EQ(uvs_of("map.exr.json"), "of the mesh");
    EXPECT_FALSE(exists("map_atlas.glb"));
    const ProgramResult one = bake("occlusion two.obj --material skin_a --size 64 -o one.exr");
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_THAT(one.err, Not(HasSubstr("covered by more than one triangle")));
    EXPECT_FALSE(exists("one_atlas.glb"));
    EXPECT_THAT(bake("occlusion two.obj --uvs fiel --size 64 -o one.exr").err, HasSubstr("file"));
}
