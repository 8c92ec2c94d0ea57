// Clips on the command line: small files of tests/mesh/gltf_pose.py.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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
    EXPECT_NE(bytes_of("all0.png"), bytes_of("all1.png"));
}

TEST_F(Moving, a_frame_of_a_clip_is_the_picture_of_its_pose_to_the_byte) {
    const std::string common = "render " + path("skin_and_morph.glb") +
                               " --unit-mm 10 -t wrap[gain=map] --clip move --size 32x32 "
                               "--camera \"eye_mm=0,0,30 target_mm=0,0,0\" ";
    const ProgramResult frames = run(common + "--time 0.25 --frames 3 --fps 2 -o " + path("frame%d.png"));
    ASSERT_EQ(frames.exit_code, 0) << frames.err;
    for (const int frame : {0, 1, 2}) {
        const ProgramResult still =
            run(common + "--time " + std::to_string(0.25 + frame / 2.0) + " -o " + path("still.png"));
        ASSERT_EQ(still.exit_code, 0) << still.err;
        EXPECT_TRUE(bytes_of("still.png") == bytes_of("frame" + std::to_string(frame) + ".png")) << frame;
    }
    EXPECT_FALSE(bytes_of("frame0.png") == bytes_of("frame1.png"));
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
    EXPECT_THAT(run("info " + mesh + " --clip move --time 1").out,
                testing::ContainsRegex("tension -?[0-9.]+ to "));
    EXPECT_THAT(run("info " + mesh).out, testing::Not(HasSubstr("tension")));
    EXPECT_THAT(run("info " + mesh + " --clip walk").err, HasSubstr("unknown clip 'walk'"));
    EXPECT_THAT(run("info " + mesh + " --morph shape9=1").err, HasSubstr("unknown morph target 'shape9'"));
    EXPECT_THAT(run("info " + mesh + " --morph shape1").err, HasSubstr("'shape1': write TARGET=WEIGHT"));
    EXPECT_THAT(run("info builtin:spheres --morph a=1").err,
                HasSubstr("builtin:spheres: morph target 'a': the mesh has none"));
    EXPECT_THAT(run("info builtin:bust --clip greet --time 1").out,
                HasSubstr("clip greet: 4 s, 5 channels\n"));
    EXPECT_THAT(run("info builtin:bust --clip walk").err, HasSubstr("builtin:bust: unknown clip 'walk'"));
    EXPECT_THAT(run("info " + mesh + " --time 1").err, HasSubstr("name one with animation.clip or --clip"));
    EXPECT_THAT(run("render " + mesh + " --fps 24 -o " + path("%d.png")).err, HasSubstr("--clip NAME"));
}

TEST_F(Moving, bakes_of_the_rest_pose_are_a_key_of_the_scene) {
    const std::string draw = "render " + path("skin_and_morph.glb") +
                             " --unit-mm 10 -t wrap[gain=map] --size 32x32 --clip move --time 0.5 ";
    const auto picture = [&](const std::string& words) {
        const ProgramResult drawn = run(draw + words + " -o " + path("one.png"));
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return bytes_of("one.png");
    };
    const std::string remade = picture("");
    EXPECT_TRUE(remade != picture("--scene animation.rest_bakes=gain"));
    EXPECT_TRUE(remade == picture("--scene animation.rest_bakes=none"));
    EXPECT_THAT(
        run(draw + "--scene animation.rest_bakes=gian -o " + path("no.png")).err,
        HasSubstr("animation.rest_bakes: unknown rest bake 'gian'; did you mean 'gain'? known: all, none"));
}

TEST_F(Moving, the_shares_of_a_clip_are_those_of_its_poses) {
    const std::string common = "compare " + path("skin_and_morph.glb") +
                               " --unit-mm 10 -t wrap[gain=map] --integrator walk --size 24"
                               " --samples-per-pixel 4 --samples 64 --noise 0.1 --timed-frames 1 --clip move"
                               " --camera \"eye_mm=0,0,30 target_mm=0,0,0\" --rest-bakes gain --json -o ";
    const auto json_of = [&](const std::string& words) {
        const ProgramResult compared = run(common + words);
        EXPECT_EQ(compared.exit_code, 0) << compared.err;
        return nlohmann::json::parse(compared.out, nullptr, false);
    };
    const nlohmann::json clip = json_of(path("clip") + " --frames 2 --fps 1.6");
    ASSERT_EQ(clip["frames"].size(), 2u);
    double sum = 0, change = 0, worst = 1;
    for (const size_t frame : {0u, 1u}) {
        const nlohmann::json pose = json_of(path("pose") + (frame == 0 ? " --time 0" : " --time 0.625")),
                             &row = clip["frames"][frame]["rows"][0];
        EXPECT_EQ(pose["judges"][0]["from_cache"], true) << "the clip has made this pose's reference";
        ASSERT_TRUE(row["walk_captured"].is_number()) << row;
        EXPECT_EQ(pose["rows"][0]["walk_captured"], row["walk_captured"]);
        EXPECT_EQ(pose["rows"][0]["rmse"], row["rmse"]);
        sum += double(row["walk_captured"]);
        worst = std::min(worst, double(row["walk_captured"]));
        if (const auto& rows = clip["frames"][frame]["rows"]; rows.size() > 1)
            change += double(rows[1]["walk_change"]["change"]);
    }
    EXPECT_NEAR(double(clip["rows"][0]["walk"]["mean"]), sum / 2, 1e-9);
    EXPECT_EQ(double(clip["rows"][0]["walk"]["worst"]), worst);
    EXPECT_NEAR(double(clip["rows"][1]["walk"]["change"]), change / 2, 1e-9);
    EXPECT_LT(change, -0.1) << "the gain of another pose is not this one's";
    for (const char* file : {"report.html", "scores.csv", "regions.csv", "frame_01/report.html"})
        EXPECT_FALSE(bytes_of(std::string("clip/") + file).empty()) << file;
    EXPECT_THAT(bytes_of("clip/clip.csv"), HasSubstr("wrap,\"gain=map,rest=gain\",walk,2,"));
}
