// Clips on the command line: small files of tests/mesh/gltf_pose.py.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

class Moving : public testing::Test {
  protected:
    void SetUp() override {
        if (!has_program("python3")) GTEST_SKIP() << "python3 is needed to write the meshes";
        const ProgramResult written =
            run_shell("python3 " DERMIS_SOURCE_DIR "/tests/mesh/gltf_pose.py write " + path(""), path(""));
        ASSERT_EQ(written.exit_code, 0) << written.err;
    }
    ProgramResult run(const std::string& words) { return run_shell(DERMIS_PROGRAM " " + words, path("")); }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }
    std::string bytes_of(const std::string& name) {
        const auto bytes = read_file(path(name));
        EXPECT_TRUE(bytes) << name;
        return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(Moving, frames_of_a_clip_do_not_depend_on_how_they_are_split) {
    const std::string common = "render " + path("skin_and_morph.glb") +
                               " -t lambert --clip move --frames 3 --fps 2 --turn 30 --size 32x32 ";
    for (const std::string& words : {"-o " + path("all%d.png"), "-o " + path("part%d.png --frame-range 0:1"),
                                     "-o " + path("part%d.png --frame-range 1:3")}) {
        const ProgramResult drawn = run(common + words);
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    }
    for (const char* number : {"0", "1", "2"})
        EXPECT_EQ(bytes_of(std::string("all") + number + ".png"),
                  bytes_of(std::string("part") + number + ".png"));
    // Frame 2 is at 1 s.
    const ProgramResult still =
        run("render " + path("skin_and_morph.glb") + " -t lambert --clip move --frames 1 --fps 1 --time 1 " +
            "--size 32x32 -o " + path("still%d.png"));
    ASSERT_EQ(still.exit_code, 0) << still.err;
    EXPECT_NE(bytes_of("all0.png"), bytes_of("all1.png"));
}

TEST_F(Moving, a_posed_mesh_has_every_vertex_in_the_order_of_the_file) {
    const std::string mesh = path("skin_8.glb");
    const ProgramResult posed = run("export-mesh " + mesh + " --clip move --time 0.9 -o " + path("a.obj"));
    ASSERT_EQ(posed.exit_code, 0) << posed.err;
    EXPECT_THAT(posed.out, HasSubstr("24 vertices, 20 triangles"));
    ASSERT_EQ(run("export-mesh " + mesh + " -o " + path("rest.obj")).exit_code, 0);
    EXPECT_NE(bytes_of("a.obj"), bytes_of("rest.obj"));
    EXPECT_THAT(run("export-mesh " + mesh + " --tone 5 -o " + path("b.obj")).err, HasSubstr("--tone"));
}

TEST_F(Moving, what_a_mesh_has_is_listed_and_what_it_lacks_is_named) {
    const std::string mesh = path("weights_linear.glb");
    EXPECT_THAT(run("info " + mesh).out, HasSubstr("clip move: 2 s, 1 channel\n"));
    EXPECT_THAT(run("info " + mesh).out, HasSubstr("3 morph targets: shape0 shape1 shape2\n"));
    EXPECT_THAT(run("info " + mesh + " --clip walk").err, HasSubstr("unknown clip 'walk'"));
    EXPECT_THAT(run("info " + mesh + " --morph shape9=1").err, HasSubstr("unknown morph target 'shape9'"));
    EXPECT_THAT(run("info " + mesh + " --morph shape1").err, HasSubstr("'shape1': write TARGET=WEIGHT"));
    EXPECT_THAT(run("info builtin:spheres --morph a=1").err, HasSubstr("morph.a"));
    EXPECT_THAT(run("render " + mesh + " --fps 24 -o " + path("%d.png")).err, HasSubstr("--clip NAME"));
}
