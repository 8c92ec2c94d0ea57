#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "dermis/image/io.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

class Commands : public testing::Test {
  protected:
    ProgramResult shell(const std::string& line) { return run_shell(line, directory_.path.string()); }
    ProgramResult dermis(const std::string& arguments) {
        return shell(std::string(DERMIS_PROGRAM) + " " + arguments);
    }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(Commands, render_prints_one_json_object_with_a_time_for_every_pass) {
    const ProgramResult result = dermis(
        "render builtin:spheres -t wrap --set wrap=0.5 --size 32x16 --frames 2 --timings --json "
        "--validate -o " +
        path("a.png"));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const nlohmann::json json = nlohmann::json::parse(result.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << result.out;
    EXPECT_EQ(json["technique"], "wrap");
    EXPECT_EQ(json["settings"]["wrap"], "0.5");
    EXPECT_EQ(json["width"], 32);
    EXPECT_EQ(json["height"], 16);
    EXPECT_TRUE(json["device"].is_string());
    EXPECT_TRUE(json["warnings"].is_array());
    EXPECT_GT(json["frame_ms"], 0.0);
    std::vector<std::string> names;
    for (const auto& pass : json["passes"]) names.push_back(pass["name"]);
    EXPECT_THAT(names, testing::ElementsAre("shadow", "background", "skin", "tone map"));
    EXPECT_EQ(read_image(path("a.png"), ImageUse::color)->image.width, 32);
}

TEST_F(Commands, frames_are_numbered_and_the_camera_turns) {
    ASSERT_EQ(
        dermis("render builtin:spheres --size 16x16 --frames 3 --turn 90 -o " + path("f%03d.png")).exit_code,
        0);
    const Image first = read_image(path("f000.png"), ImageUse::color)->image;
    const Image last = read_image(path("f002.png"), ImageUse::color)->image;
    EXPECT_NE(first.bytes, last.bytes);
    EXPECT_FALSE(std::filesystem::exists(path("f003.png")));
}

TEST_F(Commands, sixteen_bit_png_and_layered_exr_come_out) {
    ASSERT_EQ(dermis("render builtin:spheres --size 16x16 --bits 16 -o " + path("deep.png")).exit_code, 0);
    EXPECT_EQ(read_image(path("deep.png"), ImageUse::color)->image.format, PixelFormat::u16);
    ASSERT_EQ(dermis("render builtin:spheres --size 16x16 --layers -o " + path("l.exr")).exit_code, 0);
    EXPECT_EQ(read_image(path("l.exr"), ImageUse::color)->image.width, 16);
}

TEST_F(Commands, compare_writes_a_page_and_a_table_and_makes_the_reference_once) {
    const std::string command =
        "compare builtin:spheres --techniques 'lambert,preintegrated[diffuse=closed_form]' "
        "--size 32x32 --samples-per-pixel 4 --samples 16 --noise 0.0001 --timed-frames 1 --json -o " +
        path("report");
    const std::string own_cache = "DERMIS_CACHE=" + path("cache") + " " + DERMIS_PROGRAM + " ";
    const ProgramResult first = shell(own_cache + command);
    ASSERT_EQ(first.exit_code, 0) << first.err;
    const ProgramResult second = shell(own_cache + command);
    const auto json = nlohmann::json::parse(second.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << second.out;
    EXPECT_EQ(nlohmann::json::parse(first.out)["reference_from_cache"], false);
    EXPECT_EQ(json["reference_from_cache"], true);
    EXPECT_EQ(json["rows"].size(), 2u);
    EXPECT_EQ(json["rows"][0]["captured"], 0) << "lambert";
    EXPECT_EQ(json["reference_samples"], 16);
    EXPECT_THAT(first.err, HasSubstr("the reference walk stopped at its limit of 16 samples a pixel"));
    EXPECT_THAT(slurp(path("report/report.html")), HasSubstr("Content-Security-Policy"));
    EXPECT_THAT(slurp(path("report/scores.csv")),
                HasSubstr("\nbuiltin:spheres,preintegrated,diffuse=closed_form,"));
}

TEST_F(Commands, compare_that_is_stopped_ends_by_the_signal) {
    const auto stopped = [&](const std::string& scene, const std::string& seconds) {
        return dermis("compare " + scene + " -t wrap --samples 65536 --noise 0.0001 --timed-frames 1 -o " +
                      path("stopped") + " & worker=$!; sleep " + seconds +
                      "; kill -TERM $worker; wait $worker");
    };
    // Before the first samples there is nothing to report. On a slow machine the scene is not even loaded.
    for (const std::string clip : {"", " --clip greet --frames 20"}) {
        const ProgramResult early = stopped("bust --size 2048" + clip, "1.5");
        EXPECT_EQ(early.exit_code, 128 + 15) << clip << early.err;
        EXPECT_THAT(early.err, testing::AnyOf(HasSubstr("Terminated"), HasSubstr("there is no picture yet")))
            << clip;
        EXPECT_FALSE(std::filesystem::exists(path("stopped"))) << clip;
    }
    // What is cached between runs would delay the first samples.
    EXPECT_EQ(dermis("compare spheres --size 16 -t wrap --samples 144 --timed-frames 1 -o " + path("warm"))
                  .exit_code,
              0);
    const ProgramResult late = stopped("spheres --size 16", "6");
    EXPECT_EQ(late.exit_code, 128 + 15) << late.err;
    EXPECT_THAT(late.err, HasSubstr("was stopped with a noise of"));
    EXPECT_THAT(slurp(path("stopped/scores.csv")), HasSubstr("\nspheres,wrap,"));
}

TEST_F(Commands, compare_of_a_scene_without_light_prints_no_nan) {
    const ProgramResult result = dermis(
        "compare spheres --scene light.key.intensity=0 --scene environment.kind=none -t lambert,wrap --size "
        "16 "
        "--samples-per-pixel 4 --samples 8 --timed-frames 1 -o " +
        path("dark"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
    for (const char* name : {"dark/scores.csv", "dark/regions.csv"})
        EXPECT_EQ(slurp(path(name)).find("nan"), std::string::npos) << slurp(path(name));
}

TEST_F(Commands, compare_of_the_unit_scenes_has_the_exact_answer_beside_the_techniques) {
    const ProgramResult result = dermis(
        "compare unit --scene mesh.shape=relief_5mm -t lambert --size 16x16 --samples-per-pixel 4 "
        "--samples 16 --timed-frames 1 -o " +
        path("unit"));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("\nunit/relief_5mm "));
    EXPECT_THAT(slurp(path("unit/scores.csv")), HasSubstr("\nunit/relief_5mm,exact,,"));
    EXPECT_THAT(slurp(path("unit/relief_5mm/report.html")), HasSubstr("the exact answer"));
}

TEST_F(Commands, a_signal_leaves_the_picture_so_far_and_says_how_noisy_it_is) {
    for (const auto& [signal, exit_code] : {std::pair{"INT", 130}, {"TERM", 143}, {"HUP", 129}}) {
        const std::string file = path(std::string(signal) + ".exr");
        // The signal arrives when the command is at work: its whole time limit would be minutes. `timeout`
        // sends it twice, to the process and to its group; that must not end the program at once.
        const ProgramResult stopped =
            shell("timeout --preserve-status -s " + std::string(signal) + " 3 " + DERMIS_PROGRAM +
                  " reference builtin:spheres --size 32x32 --samples 60000 -o " + file);
        EXPECT_EQ(stopped.exit_code, exit_code) << stopped.err;
        EXPECT_THAT(stopped.out,
                    testing::ContainsRegex("stopped after [0-9]+ passes, relative error 0\\.[0-9]+"));
        const auto layers = read_layered_exr(file);
        ASSERT_TRUE(layers) << layers.error().message;
        EXPECT_GT(layers->layers.size(), 4u);
    }
}

TEST_F(Commands, a_reference_that_misses_its_noise_is_written_and_says_so) {
    const std::string file = path("reference.exr"),
                      line =
                          std::string(DERMIS_PROGRAM) + " reference builtin:spheres --size 16x16 -o " + file;
    const ProgramResult missed = shell(line + " --noise 0.0001 --samples 16");
    EXPECT_EQ(missed.exit_code, 3) << missed.err;
    EXPECT_THAT(missed.err, HasSubstr("after 16 samples a pixel, not the 0.0001 of --noise"));
    EXPECT_TRUE(read_layered_exr(file));
    const ProgramResult reached = shell(line + " --noise 0.05 --json");
    EXPECT_EQ(reached.exit_code, 0) << reached.err;
    EXPECT_EQ(nlohmann::json::parse(reached.out)["noise_reached"], true);
}

TEST_F(Commands, passes_and_techniques_need_no_device) {
    // No driver can be found: anything that opened a device would fail.
    const std::string no_driver = "VK_DRIVER_FILES=/nowhere VK_ICD_FILENAMES=/nowhere ";
    const ProgramResult passes = shell(no_driver + DERMIS_PROGRAM " passes lambert");
    EXPECT_EQ(passes.exit_code, 0) << passes.err;
    EXPECT_THAT(passes.out,
                HasSubstr("pass skin  [geometry, screen]  lambert/lambert.frag  reads shadow_map"));
    const ProgramResult techniques = shell(no_driver + DERMIS_PROGRAM " techniques --json");
    EXPECT_EQ(techniques.exit_code, 0);
    EXPECT_TRUE(nlohmann::json::parse(techniques.out, nullptr, false).is_array());
    const ProgramResult render =
        shell(no_driver + DERMIS_PROGRAM " render builtin:spheres -o " + path("a.png"));
    EXPECT_EQ(render.exit_code, 1);
    EXPECT_THAT(render.err, HasSubstr("mesa-vulkan-drivers"));
}

TEST_F(Commands, a_new_technique_is_a_folder_that_compiles_as_it_is) {
    const std::string root = DERMIS_SOURCE_DIR;
    const ProgramResult made = shell("DERMIS_TECHNIQUES=" + directory_.path.string() + " " + root +
                                     "/tools/new_technique my_skin 'a test'");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const std::string folder = path("my_skin");
    const ProgramResult shader = shell("glslc --target-env=vulkan1.3 -Werror -fauto-bind-uniforms -I " +
                                       root + " -o " + path("a.spv") + " " + folder + "/my_skin.frag");
    EXPECT_EQ(shader.exit_code, 0) << shader.err;
    for (const char* source : {"technique.cpp", "my_skin_test.cpp"}) {
        const ProgramResult code = shell(std::string(DERMIS_COMPILER) + " -std=c++20 -fsyntax-only -I " +
                                         root + " -I " + root + "/tests " + folder + "/" + source);
        EXPECT_EQ(code.exit_code, 0) << code.err;
    }
    EXPECT_TRUE(std::filesystem::exists(folder + "/README.md"));
    EXPECT_NE(
        shell("DERMIS_TECHNIQUES=" + directory_.path.string() + " " + root + "/tools/new_technique my_skin x")
            .exit_code,
        0);
    EXPECT_NE(shell(root + "/tools/new_technique 'Bad Name'").exit_code, 0);
}

TEST_F(Commands, a_profile_is_written_as_materialx_and_read_by_a_scene_beside_it) {
    const ProgramResult written =
        dermis("profile convert gpu_gems_3 --albedo 0.8,0.6,0.5 -o " + path("skin.mtlx"));
    ASSERT_EQ(written.exit_code, 0) << written.err;
    EXPECT_THAT(written.out, HasSubstr("the shape of gpu_gems_3 (sum of Gaussians) is lost"));
    ASSERT_EQ(dermis("profile show " + path("skin.mtlx")).exit_code, 0);
    std::ofstream(path("a.toml"))
        << "[[mesh]]\nfile = \"builtin:spheres\"\n[skin]\nprofile = \"skin.mtlx\"\n";
    const ProgramResult drawn = dermis("render " + path("a.toml") + " --size 16x16 -o " + path("a.png"));
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    const ProgramResult refused = dermis("profile convert gpu_gems_3 -o " + path("skin.txt"));
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr(".mtlx"));
}
