// Every command that writes: what cannot be written, what would be written twice and what is an input is
// refused before anything else is looked at.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "cli/help_pages.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

// Each call has something else that is wrong (a scene that is missing, an unknown profile): the error names
// the output all the same, so nothing else was begun. OUT is a path in a folder that cannot be made.
struct OutputCall {
    const char *command, *flag, *arguments;
};
constexpr OutputCall kOutputCalls[] = {
    {"bake beckmann", "-o", "--layout none -o OUT.exr"},
    {"bake beckmann", "--plot", "--layout none -o a.exr --plot OUT.svg"},
    {"bake closed_form", "-o", "--profile none -o OUT.csv"},
    {"bake closed_form", "--plot", "--profile none --plot OUT.svg"},
    {"bake lut", "-o", "--profile none -o OUT.exr"},
    {"bake lut", "--plot", "--profile none -o a.exr --plot OUT.svg"},
    {"bake shadow", "-o", "--profile none -o OUT.exr"},
    {"bake shadow", "--plot", "--profile none -o a.exr --plot OUT.svg"},
    {"bake zh", "-o", "--profile none -o OUT.exr"},
    {"bake zh", "--plot", "--profile none -o a.exr --plot OUT.svg"},
    {"bake curvature", "-o", "none.obj -o OUT.exr"},
    {"bake thickness", "-o", "none.obj -o OUT.exr"},
    {"bake kernel-size", "-o", "none.obj -o OUT.exr"},
    {"bake stretch", "-o", "none.obj -o OUT.exr"},
    {"bake occlusion", "-o", "none.obj -o OUT.exr"},
    {"bake gain", "-o", "none.obj -o OUT.exr"},
    {"bake normals", "-o", "none.obj -o OUT.exr"},
    {"bake pigments", "-o", "none.png -o OUT.png"},
    {"compare", "-o", "none.toml -o OUT"},
    {"export", "-o", "--language hlsl --profile none -o OUT.hlsl"},
    {"export", "-o", "--language all --profile none -o OUT"},
    {"export", "-o", "--engine unity --profile none -o OUT"},
    {"export", "-o", "--web none.toml -o OUT"},
    {"export-mesh", "-o", "builtin:none -o OUT.glb"},
    {"export-mesh", "--maps", "builtin:none -o a.obj --maps OUT"},
    {"figures", "-o", "preintegrated none.toml -o OUT"},
    {"jobs", "--folder", "none.txt --folder OUT"},
    {"merge", "-o", "none.exr -o OUT.exr"},
    {"merge", "--preview", "none.exr -o a.exr --preview OUT.png"},
    {"new-scene", "-o", "none.obj -o OUT.toml"},
    {"profile fit-walk", "-o", "none -o OUT.csv"},
    {"profile skin", "--chart", "--melanin .1 --chart OUT.png"},
    {"profile list", "--plot", "--plot OUT.svg"},
    {"profile show", "--plot", "none --plot OUT.svg"},
    {"profile convert", "-o", "none -o OUT.mtlx"},
    {"reference", "-o", "none.toml -o OUT.exr"},
    {"reference", "--preview", "none.toml -o a.exr --preview OUT.png"},
    {"render", "-o", "none.toml -o OUT.png"},
    {"render", "-o", "none.toml --frames 9 -o OUT_%d.png"},
    {"view", "-o", "none.toml --turntable 3 -o OUT_%d.png"},
    {"view", "-o", "none.toml --turntable 3 -o OUT.mp4"},
};

// Two outputs in one file, or an output over an input, by another name of it each time.
struct LossCall {
    const char *command, *lost;
};
constexpr LossCall kLossCalls[] = {
    {"bake lut --size 8 -o new.csv --plot ./new.csv", "new.csv"},
    {"bake lut --size 8 -o new.exr --plot new.exr.json", "new.exr.json"},
    {"bake lut --size 8 --profile skin.csv -o link.csv", "link.csv"},
    {"bake closed_form --profile skin.csv -o skin.csv", "skin.csv"},
    {"bake closed_form -o new.svg --plot sub/../new.svg", "new.svg"},
    {"bake curvature scene.toml --size 16 -o map.exr", "map.exr"},
    {"bake normals scene.toml --size 16 -o map.exr", "map_red.exr"},
    {"reference scene.toml --size 8 --samples 4 -o new.exr --preview new.exr", "new.exr"},
    {"reference scene.toml --size 8 --samples 4 -o new.exr --preview albedo.png", "albedo.png"},
    {"merge skin.csv part.exr -o part.exr", "part.exr"},
    {"merge part.exr -o hard.exr", "hard.exr"},
    {"render scene.toml --size 8 -o albedo.png", "albedo.png"},
    {"render scene.toml --size 8 -o link.png", "link.png"},
    {"render scene.toml --size 8 --frames 3 -o numbered_%d.png", "numbered_2.png"},
    {"view scene.toml --size 8 --turntable 3 -o numbered_%d.png", "numbered_2.png"},
    {"view scene.toml --script over_script.txt", "over_script.txt"},
    {"view scene.toml --script twice.txt", "twice.png"},
    {"figures preintegrated scene.toml --only normals -o .", "normals.png"},
    {"profile convert skin.mtlx -o ./skin.mtlx", "skin.mtlx"},
    {"export --language hlsl --profile skin.csv -o skin.csv", "skin.csv"},
    {"export-mesh --profile albedo.png -o new.glb --maps .", "albedo.png"},
    {"jobs out/work.txt --folder out", "work.txt"},
    {"jobs same.txt --folder out", "new.png"},
};

constexpr const char* kSceneOfOutputs =
    "[[mesh]]\nfile = \"mesh.obj\"\nunit_mm = 1\n[maps]\nalbedo = \"albedo.png\"\nnormal = \"normals.png\"\n"
    "specular = \"numbered_2.png\"\nocclusion = \"map.exr\"\nthickness = \"map_red.exr\"\n";
constexpr const char* kMeshOfOutputs = "v 0 0 0\nv 90 0 0\nv 0 90 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

class Outputs : public testing::Test {
  protected:
    ProgramResult dermis(const std::string& arguments) {
        return run_shell(
            "cd " + path("work") + " && DERMIS_CACHE=" + path("cache") + " " DERMIS_PROGRAM " " + arguments,
            directory_.path.string());
    }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }
    void SetUp() override { fs::create_directories(path("work/sub")); }
    void write(const std::string& name, const std::string& text) {
        std::ofstream(path("work/" + name), std::ios::binary) << text;
    }
    // The names and contents of all files.
    std::map<std::string, std::string> content() {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(path("work")))
            files[entry.path().string()] = entry.is_regular_file() ? slurp(entry.path().string()) : "";
        return files;
    }
    void expect_refused(const std::string& line, const std::string& named, const std::string& reason) {
        const std::map<std::string, std::string> before = content();
        const ProgramResult result = dermis(line);
        EXPECT_EQ(result.exit_code, 1) << line;
        EXPECT_THAT(result.err, HasSubstr(named)) << line;
        EXPECT_THAT(result.err, testing::ContainsRegex(reason)) << line;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << line << ": " << result.err;
        EXPECT_EQ(result.out, "") << line;
        EXPECT_TRUE(content() == before) << line;
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(Outputs, what_cannot_be_written_is_refused_before_anything_else_by_every_command) {
    write("plain", "a file, in which no folder can be made");
    std::set<std::pair<std::string, std::string>> known;
    for (const OutputCall& call : kOutputCalls) {
        known.insert({call.command, call.flag});
        for (const std::string out : {"plain/x", "/proc/x"}) {
            std::string arguments = call.arguments;
            arguments.replace(arguments.find("OUT"), 3, out);
            expect_refused(std::string(call.command) + " " + arguments, out.substr(0, out.size() - 2),
                           "cannot (write|make the directory)");
        }
    }
    for_each_command(directory_.path.string(), [&](const std::string& command, const HelpPage& page) {
        for (const HelpOption& option : page.options)
            if (option.type == "OUTPUT")
                EXPECT_TRUE(known.contains({command, option.name}))
                    << "no call in this test for " << command << " " << option.name;
            else if (option.type == "TEXT")
                EXPECT_FALSE(option.name == "-o" || option.name == "--plot" || option.name == "--preview")
                    << command << " " << option.name << " is declared by add_output()";
    });
    EXPECT_FALSE(fs::exists(path("cache"))) << "something was computed";
}

TEST_F(Outputs, a_sidecar_that_cannot_be_written_is_refused_before_the_table_is_read) {
    expect_refused("lint /proc/none.png --write-sidecar", "/proc/none.png.json", "cannot write");
}

TEST_F(Outputs, what_a_script_of_the_viewer_cannot_write_is_refused_before_a_window_opens) {
    write("script.txt", "save /proc/none.toml\nquit\n");
    expect_refused("view none.toml --script script.txt", "/proc/none.toml", "cannot write");
}

TEST_F(Outputs, nothing_is_written_twice_or_over_an_input) {
    ASSERT_EQ(
        dermis("bake lut --size 8 --storage 8 -o albedo.png && cp albedo.png normals.png && "
               "cp albedo.png numbered_2.png && rm albedo.png.json && " DERMIS_PROGRAM
               " bake lut --size 8 -o map.exr && cp map.exr map_red.exr && rm map.exr.json && " DERMIS_PROGRAM
               " profile convert gpu_gems_3 -o skin.mtlx && " DERMIS_PROGRAM
               " reference spheres --size 8 --samples 8 --probes 6 --sample-range 0:4 -o part.exr && "
               "ln part.exr hard.exr && ln -s albedo.png link.png && ln -s skin.csv link.csv && mkdir out")
            .exit_code,
        0);
    write("scene.toml", kSceneOfOutputs);
    write("mesh.obj", kMeshOfOutputs);
    write("skin.csv", "radius_mm,r,g,b\n0,1,1,1\n1,0.5,0.2,0.1\n9,0,0,0\n");
    write("out/work.txt", "render spheres -o new.png\n");
    write("over_script.txt", "capture sub/../over_script.txt\nquit\n");
    write("twice.txt", "screenshot twice.png\ncapture ./twice.png\nquit\n");
    write("same.txt", "render spheres -o new.png\nrender spheres -t wrap -o ./new.png\n");
    for (const LossCall& call : kLossCalls)
        expect_refused(call.command, call.lost, "would be replaced|two outputs");
}

TEST_F(Outputs, an_output_that_is_only_there_already_is_replaced) {
    write("new.csv", "old");
    fs::create_symlink("/dev/null", path("work/null.svg"));
    EXPECT_EQ(dermis("bake closed_form --rows 9 -o new.csv --plot null.svg").exit_code, 0);
    EXPECT_THAT(slurp(path("work/new.csv")), HasSubstr("curvature_per_mm"));
}
