// Every error is one line that names the cause, with a non-zero exit, nothing half-written and no crash.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/help_pages.h"
#include "cli/run_program.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

class BadInput : public testing::Test {
  protected:
    ProgramResult dermis(const std::string& arguments) {
        return run_shell(std::string(DERMIS_PROGRAM) + " " + arguments, directory_.path.string());
    }
    void expect_error(const std::string& arguments, const std::string& message) {
        const ProgramResult result = dermis(arguments);
        EXPECT_TRUE(result.exit_code == 1 || result.exit_code == 2)
            << arguments << ": exit " << result.exit_code;
        EXPECT_THAT(result.err, HasSubstr(message)) << arguments;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(result.out, "") << arguments;
    }
    std::string file(const std::string& name, const std::string& content) {
        std::ofstream(directory_.path / name, std::ios::binary) << content;
        return (directory_.path / name).string();
    }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    TemporaryDirectory directory_;
};

constexpr const char* kQuick = "render builtin:spheres --size 16x16 -o ";

}  // namespace

TEST_F(BadInput, names_of_files_and_in_files_reach_the_terminal_as_one_printable_line) {
    const std::string name = file("a\x1b[31m\nb.obj", "v 0 0\n");
    expect_error("info '" + name + "'", "a?[31m?b.obj:1: a vertex needs three numbers");
    expect_error("render 'no\x1b[31m\nname'", "no?[31m?name");
    const std::string good = file("c\n\x1b.obj", "usemtl x\x1b[31my\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const ProgramResult info = dermis("info '" + good + "'");
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("x?[31my: 1 triangles"));
    EXPECT_EQ(info.out.find('\x1b'), std::string::npos);
}

TEST_F(BadInput, pipes_and_devices_are_refused_at_once) {
    ASSERT_EQ(::mkfifo(path("pipe.obj").c_str(), 0600), 0);
    expect_error("info " + path("pipe.obj"), "pipe.obj: is a pipe, device or socket");
    expect_error("lint /dev/zero", "/dev/zero: is a pipe, device or socket");
}

TEST_F(BadInput, options_that_are_wrong_say_what_would_be_right) {
    expect_error("", "A subcommand is required");
    expect_error("rendr", "unknown command 'rendr'; did you mean 'render'?");
    expect_error("render builtin:spheres --size 0x4", "--size '0x4': write WIDTHxHEIGHT");
    expect_error("render builtin:spheres --size 99999x4", "each 1 to 8192");
    expect_error("render builtin:spheres --technique lambart", "did you mean 'lambert'?");
    expect_error("render builtin:spheres --set roughness=1", "unknown parameter 'roughness'");
    expect_error("render builtin:spheres --technique wrap --set wrap=3", "'3' is not in its range, 0 to 1");
    expect_error("render builtin:spheres --technique wrap --set wrap", "--set: 'wrap': write name=value");
    expect_error("render builtin:spheres --samples 3", "--samples 3: 1 or 4");
    expect_error("render builtin:spheres --view norml", "did you mean 'normal'?");
    expect_error("render builtin:spheres --camera 'yaw_deg=x'", "yaw_deg is a number");
    expect_error("render builtin:spheres --light 'pitch_deg=1000'", "pitch_deg is a number");
    expect_error("render builtin:spheres --frames 0", "--frames: 0 is not in its range, 1 to 100000");
    expect_error("figures lambart", "did you mean 'lambert'?");
    expect_error("figures lambert", "technique 'lambert' has no figures");
    expect_error("figures preintegrated --only nromals", "unknown figure 'nromals'; did you mean 'normals'?");
    expect_error("figures preintegrated --size 5", "--size: 5 is not in its range, 16 to 2048");
    expect_error("render builtin:spheres -o a.tga", "a.tga: a picture is a .png or an .exr file");
    expect_error("render builtin:spheres --device none", "none");
    expect_error("passes lambart", "did you mean 'lambert'?");
    expect_error("techniques lambart", "did you mean 'lambert'?");
}

TEST_F(BadInput, comparisons_that_cannot_be_made_leave_nothing) {
    const std::string to = " -o " + path("report");
    expect_error("compare builtin:spheres --techniques lambart" + to, "did you mean 'lambert'?");
    expect_error("compare builtin:spheres --techniques 'wrap[wrap=0.4'" + to, "brackets do not match");
    expect_error("compare builtin:spheres --techniques 'wrap[wrap=9]'" + to,
                 "'9' is not in its range, 0 to 1");
    expect_error("compare builtin:spheres --size 9x" + to, "--size '9x'");
    expect_error("compare builtin:spheres --picture mine=a.exr" + to,
                 "--picture: 'mine=a.exr': write NAME=with.exr,without.exr");
    expect_error("compare builtin:spheres --picture mine=none.exr,b.exr" + to, "--picture: none.exr: ");
    expect_error("compare unit --picture mine=a.exr,b.exr" + to, "--picture: unit is a set of scenes");
    expect_error("compare builtin:spheres --timed-frames 0" + to,
                 "--timed-frames: 0 is not in its range, 1 to 1000");
    expect_error("compare builtin:spheres --frames 0" + to, "--frames: 0 is not in its range, 1 to 1000");
    expect_error("compare builtin:spheres --frames 5" + to, "--clip NAME --frames 8");
    expect_error("export --engine three --functions skin_gain" + to,
                 "--functions chooses what --language writes");
    expect_error("compare builtin:spheres --fps 24" + to, "--clip NAME --frames 8 --fps 24");
    expect_error("compare builtin:spheres --rest-bakes normal" + to, "did you mean 'normals'?");
    expect_error("compare builtin:spheres --rest-bakes all" + to, "does not move");
    expect_error("compare builtin:spheres --integrator walkk" + to, "did you mean 'walk'?");
    expect_error("compare builtin:spheres --size 16x16 --samples 1" + to,
                 "--samples: 1 is not in its range, 4 to 1048576");
    expect_error("compare builtin:spheres --samples-per-pixel 15" + to, "a square number");
    expect_error("compare no/such.toml" + to, "no/such.toml");
    expect_error("compare unit --scene mesh.shape=cilinder" + to, "did you mean 'cylinder'?");
    expect_error("compare unit --scene mesh.scale=2" + to, "--scene mesh.scale: of the set of test scenes");
    EXPECT_FALSE(fs::exists(path("report")));
    expect_error("compare builtin:spheres -o " + file("plain", "x"), "is a file; name a directory");
}

TEST_F(BadInput, references_that_cannot_be_made_leave_nothing) {
    const std::string to = " -o " + path("reference.exr");
    expect_error("reference builtin:spheres -o reference.png", "name a .exr file");
    expect_error("reference builtin:spheres --integrator wolk" + to, "did you mean 'walk'?");
    expect_error("reference builtin:spheres --medium 'sigma=1'" + to, "--medium: 'sigma=1'");
    expect_error("reference builtin:spheres --medium 'g=0.5'" + to, "add --integrator walk");
    expect_error("reference builtin:spheres --probes 0" + to, "--probes: 0 is not in its range, 1 to 65536");
    expect_error("reference builtin:spheres --noise 2" + to, "--noise: 2 is not in its range");
    expect_error("reference builtin:spheres --size 0x8" + to, "0");
    expect_error("reference builtin:spheres --profile jensen" + to, "jensen");
    // A picture that would take hours is not begun when it cannot be written.
    const std::string hours = "reference builtin:spheres --samples 65536 --size 1024x1024 ";
    expect_error(hours + "-o /proc/reference.exr", "/proc/reference.exr: cannot write");
    expect_error(hours + "--preview " + path("reference.gif") + to, "--preview");
    fs::create_directory(path("folder.exr"));
    expect_error(hours + "-o " + path("folder.exr"), "is a directory");
    fs::create_directory(path("folder.png"));
    expect_error(hours + "--preview " + path("folder.png") + to, "is a directory");
    EXPECT_FALSE(fs::exists(path("reference.exr")));
}

TEST_F(BadInput, scenes_and_meshes_that_cannot_be_read_are_named) {
    expect_error("render builtin:sphere", "did you mean 'spheres'?");
    expect_error("render no/such.toml", "no/such.toml");
    expect_error("render " + directory_.path.string(), directory_.path.string());
    expect_error("render " + file("empty.obj", ""), "empty.obj");
    expect_error("render " + file("short.glb", "glTF"), "short.glb");
    expect_error("render " + file("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "nan.obj");
    expect_error("render " + file("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "far.obj");
    expect_error("render " + file("bad.toml", "[camra]\n"), "bad.toml:1");
    expect_error("render " + file("cut.toml", "[camera\n"), "cut.toml");
}

TEST_F(BadInput, maps_that_cannot_be_read_are_named) {
    file("broken.png", "\x89PNG\r\n\x1a\n....");
    const std::string scene =
        file("scene.toml", "[[mesh]]\nfile = \"builtin:spheres\"\n[maps]\nalbedo = \"broken.png\"\n");
    expect_error("render " + scene + " --size 16x16 -o " + path("a.png"), "broken.png");
    EXPECT_FALSE(fs::exists(path("a.png")));
}

TEST_F(BadInput, outputs_that_cannot_be_written_keep_the_old_file) {
    fs::create_directory(path("folder.png"));
    expect_error(kQuick + path("folder.png"), "folder.png: is a directory");
    const std::string plain = file("plain", "x");
    expect_error(kQuick + plain + "/a.png", "plain: cannot make the directory: Not a directory");
    if (fs::exists("/dev/full")) {
        // A link, so that the name ends in .png.
        fs::create_symlink("/dev/full", path("full.png"));
        expect_error(kQuick + path("full.png"), "full.png: cannot write");
    }
    for (const auto& entry : fs::directory_iterator(directory_.path))
        EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
}

TEST_F(BadInput, a_closed_or_full_standard_output_is_an_error) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    for (const char* command : {"techniques", "--help", "profile list", "info builtin:spheres --json"})
        expect_error(std::string(command) + " > /dev/full", "standard output: cannot write");
}

TEST_F(BadInput, out_of_memory_is_one_line) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "AddressSanitizer reserves more memory than the limit";
#endif
    expect_error("bake lut --size 64x64 -o " + path("good.exr") +
                     " >/dev/null && ulimit -v 1500000 && " DERMIS_PROGRAM
                     " bake lut --size 8192x8192 -o a.exr",
                 "out of memory");
    EXPECT_FALSE(fs::exists(path("a.exr")));
}

TEST_F(BadInput, keys_of_any_depth_are_refused) {
    std::string deep = "a";
    for (int i = 0; i < 50000; ++i) deep += ".a";
    expect_error("render " + file("key.toml", "x = 1\n" + deep + " = 1\n"), "key.toml:2: nested deeper than");
    expect_error("render " + file("table.toml", "[" + deep + "]\n"), "table.toml:1: nested deeper than");
}

TEST_F(BadInput, messages_say_how_to_correct_the_input) {
    expect_error("info " + file("none.glb", ""), "none.glb: the file is empty");
    expect_error("render " + file("point.toml", "[skin]\nroughness = .4\n"), "write 0.5, not .5");
    expect_error(kQuick + path("x.png") + " --frames 3", "number them: -o out/%04d.png");
    expect_error("info builtin:spheres --unit-mm 2", "--unit-mm is for mesh files");
}

TEST_F(BadInput, numbers_are_finite) {
    expect_error("render spheres --turn nan", "--turn: nan is not a finite number");
    expect_error("info a.obj --unit-mm inf", "--unit-mm: inf is not a finite number");
    expect_error("passes lambert --samples 3", "--samples 3: 1 or 4");
    expect_error("passes lambert --view zz", "unknown view 'zz'");
}

TEST_F(BadInput, numbers_that_meant_nothing_are_refused) {
    const std::string to = " -o " + path("a.exr");
    for (const char* unit : {"-1", "0", "1e-320"}) {
        expect_error("bake curvature head.obj --unit-mm " + std::string(unit) + to, "--unit-mm: ");
        expect_error("bake normals head.obj --unit-mm " + std::string(unit) + to, "--unit-mm: ");
    }
    expect_error("bake lut --variance-scale 0" + to, "--variance-scale: 0 is not in its range");
    expect_error("reference spheres --samples 0" + to, "--samples: 0 is not in its range, 2 to 65536");
}

TEST_F(BadInput, flags_without_effect_are_refused) {
    const std::string to = " -o " + path("a.exr");
    expect_error("bake curvature spheres --unit-mm 2" + to, "--unit-mm is for mesh files");
    expect_error("bake normals bust --unit-mm 2" + to, "--unit-mm is for mesh files");
    expect_error("render spheres --turn 90" + to, "--turn has no effect on one picture");
    expect_error("reference spheres --integrator lambert --profile jensen_skin1" + to,
                 "--profile has no effect on --integrator lambert");
    expect_error("reference spheres --cavities open" + to,
                 "--cavities has no effect on --integrator surface");
    expect_error("view spheres --turntable 2 --script a.txt", "--script has no effect on --turntable");
}

TEST_F(BadInput, a_camera_that_looks_nowhere_is_refused) {
    const std::string words =
        " --scene camera.eye_mm=1,2,3 --scene camera.target_mm=1,2,3 --size 16 -o " + path("a.exr");
    expect_error("render spheres" + words, "camera.eye_mm and camera.target_mm are the same point, 1 2 3");
    expect_error("reference spheres" + words, "the same point");
    expect_error("compare unit --scene camera.eye_mm=1,2,3 --scene camera.target_mm=1,2,3 -o " + path("out"),
                 "the same point");
}

TEST_F(BadInput, viewers_that_would_wait_for_ever_or_show_something_else_are_refused) {
    expect_error("view spheres --reference " + path("missing.exr"), "--reference: ");
    expect_error("view spheres -o " + path("a.mp4"), "-o has no effect without --turntable");
    expect_error("view spheres --shaders " + path("none"), "has no folder shaders/");
    expect_error("view spheres --frames 0", "--frames: 0 is not in its range, 1 to 1000000000");
}

TEST_F(BadInput, a_warning_of_many_meshes_comes_once_with_its_count) {
    file("mesh.obj", "mtllib none.mtl\nv 0 0 0\nv 90 0 0\nv 0 90 0\nf 1 2 3\n");
    std::string scene;
    for (int i = 0; i < 40; ++i) scene += "[[mesh]]\nfile = \"mesh.obj\"\nunit_mm = 1\n";
    const ProgramResult drawn =
        dermis("render " + file("many.toml", scene) + " --size 16 -o " + path("a.png"));
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_THAT(drawn.err, HasSubstr("(40 times)"));
    EXPECT_LT(std::count(drawn.err.begin(), drawn.err.end(), '\n'), 10) << drawn.err;
}

TEST_F(BadInput, output_paths_reach_the_terminal_as_printable_text) {
    const std::string name = path("a\x1b[31m\u202eb");
    for (const std::string& line :
         {"bake lut --size 8 -o '" + name + ".exr'", "bake closed_form --rows 9 -o '" + name + ".csv'",
          "render spheres --size 8 -o '" + name + ".png'", "export --language hlsl -o '" + name + ".hlsl'",
          "reference spheres --size 8 --samples 2 --probes 6 -o '" + name + ".exr'",
          "profile convert gpu_gems_3 -o '" + name + ".mtlx'"}) {
        const ProgramResult written = dermis(line);
        EXPECT_EQ(written.exit_code, 0) << written.err;
        EXPECT_THAT(written.out, HasSubstr("a?[31m?b")) << line;
        EXPECT_EQ(written.out.find('\x1b'), std::string::npos) << line;
    }
}

TEST_F(BadInput, help_of_every_command_has_an_example_and_lines_of_at_most_80_columns) {
    const auto expect_fits = [](const std::string& name, const std::string& text) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            EXPECT_LE(line.size(), 80u) << name << ": " << line;
        EXPECT_THAT(text, HasSubstr("Example:\n  dermis ")) << name;
    };
    expect_fits("dermis", dermis("--help").out);
    size_t commands = 0;
    for_each_command(directory_.path.string(), [&](const std::string& command, const HelpPage&) {
        expect_fits(command, dermis(command + " --help").out);
        ++commands;
    });
    EXPECT_GT(commands, 25u);
}
