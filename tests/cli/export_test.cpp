// dermis export and the tables for engines, as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "support/environment.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

class Export : public testing::Test {
  protected:
    ProgramResult dermis(const std::string& arguments) {
        return run_shell(std::string(DERMIS_PROGRAM) + " " + arguments, scratch_.path.string());
    }
    void expect_refused(const std::string& arguments, const std::string& message) {
        const ProgramResult result = dermis(arguments);
        EXPECT_NE(result.exit_code, 0) << arguments;
        EXPECT_THAT(result.err, HasSubstr(message)) << arguments;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(result.out, "") << arguments;
        EXPECT_TRUE(fs::is_empty(out_.path)) << arguments;
    }
    std::string out(const std::string& name) const { return (out_.path / name).string(); }

    TemporaryDirectory scratch_, out_;
};

}  // namespace

TEST_F(Export, an_engine_gets_a_folder_and_the_printed_files_are_in_it) {
    for (const char* engine : {"unity", "unreal", "godot"}) {
        const std::string folder = out(engine);
        const ProgramResult result =
            dermis("export --engine " + std::string(engine) + " --profile openpbr_skin_5 -o " + folder);
        ASSERT_EQ(result.exit_code, 0) << result.err;
        size_t files = 0;
        for (size_t at = 0, end; (end = result.out.find('\n', at)) != std::string::npos;
             at = end + 1, ++files)
            EXPECT_TRUE(fs::is_regular_file(result.out.substr(at, end - at))) << result.out;
        EXPECT_GE(files, 8u) << engine;
        EXPECT_TRUE(fs::exists(folder + "/README.md"));
    }
}

TEST_F(Export, of_every_openpbr_tone_has_a_package) {
    for (int tone = 1; tone <= 6; ++tone)
        EXPECT_EQ(dermis("export --engine godot --profile openpbr_skin_" + std::to_string(tone) + " -o " +
                         out("tone_" + std::to_string(tone)))
                      .exit_code,
                  0)
            << tone;
}

// The cache has what was walked.
TEST_F(Export, walks_the_gain_only_for_functions_that_need_it) {
    const EnvironmentVariable cache("DERMIS_CACHE", out("cache"));
    const auto has_cache = [&](const std::string& functions) {
        const std::string command = "export --language hlsl --functions " + functions +
                                    " --profile openpbr_skin_5 -o " + out("skin.hlsl");
        EXPECT_EQ(dermis(command).exit_code, 0) << functions;
        return fs::exists(out("cache"));
    };
    EXPECT_FALSE(has_cache("skin_diffuse,skin_gather_trust"));
    EXPECT_TRUE(has_cache("skin_gain"));
}

// Skin 5 mm over a card, whose alpha map alone differs.
TEST_F(Export, does_not_take_a_thickness_from_the_cache_that_another_alpha_map_gave) {
    const EnvironmentVariable cache("DERMIS_CACHE", out("cache"));
    const auto write = [&](const std::string& name, const std::string& text) {
        ASSERT_TRUE(write_text_file(scratch_.path / name, text));
    };
    write("sheet.obj",
          "mtllib sheet.mtl\nv -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nv -20 -20 -5\nv 20 -20 -5\n"
          "v 20 20 -5\nv -20 20 -5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl skin\nf 1/1 2/2 3/3 4/4\n"
          "usemtl card\nf 5/1 6/2 7/3 8/4\n");
    write("sheet.mtl", "newmtl skin\nnewmtl card\nmap_d card.png\n");
    write("scene.toml",
          "[[mesh]]\nfile = \"sheet.obj\"\nunit_mm = 1\n[material.skin]\nclass = \"skin\"\n"
          "[material.card]\nclass = \"other\"\n");
    const auto thickness_behind = [&](float alpha) {
        Image card(4, 4, 1, PixelFormat::u8);
        for (int i = 0; i < 16; ++i) card.set(i % 4, i / 4, 0, alpha);
        EXPECT_TRUE(write_image(scratch_.path / "card.png", card));
        const ProgramResult made = dermis("export --engine unity " + (scratch_.path / "scene.toml").string() +
                                          " -o " + out("package"));
        EXPECT_EQ(made.exit_code, 0) << made.err;
        const auto map = read_image(out("package/Head/thickness.png"), ImageUse::data);
        return map ? map->image.at(map->image.width / 2, map->image.height / 2, 0) : -1;
    };
    EXPECT_LT(thickness_behind(1), 0.5f);
    EXPECT_EQ(thickness_behind(0), 1) << "there is nothing behind";
}

TEST_F(Export, refuses_wrong_options_and_leaves_nothing) {
    expect_refused("export --engine godott -o " + out("p"), "unknown engine 'godott'; did you mean 'godot'?");
    expect_refused("export --engine godot --profile gpu_gems -o " + out("p"), "unknown profile 'gpu_gems'");
    expect_refused("export --engine godot --language hlsl -o " + out("p"), "give one of --language");
    expect_refused("export -o " + out("p"),
                   "give one of --language for a file of functions, --engine for a folder");
    expect_refused("export --engine godot", "--output is required");
    expect_refused("export --engine godot -o /dev/null/p", "/dev/null/p: cannot make the directory");
}

// A folder that is a file, or in which one of the files cannot be written: nothing is written.
TEST_F(Export, writes_all_files_or_none) {
    const std::string folder = out("p");
    fs::create_directories(folder + "/addons/dermis_skin/skin_material.tres");
    const ProgramResult result = dermis("export --engine godot -o " + folder);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("skin_material.tres: is a directory"));
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        EXPECT_TRUE(entry.is_directory()) << entry.path();
}

// Burley has a pole, which a ring cannot integrate: the table is of its fit, and says how good that is.
TEST_F(Export, tables_of_published_conventions_are_made_for_every_openpbr_tone) {
    for (const char* convention : {"unity_2011", "penner", "faceworks"}) {
        const ProgramResult result = dermis("bake lut --size 32 --convention " + std::string(convention) +
                                            " --profile openpbr_skin_5 -o " + out(convention) + ".png");
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_THAT(result.out,
                    HasSubstr("the profile is Burley and this convention needs Gaussians: fitted, 0.23 %"));
        EXPECT_EQ(result.out.find("are cut") != std::string::npos, convention == std::string("faceworks"))
            << result.out;
    }
    const ProgramResult zonal =
        dermis("bake zh --construction full_ring --profile openpbr_skin_5 -o " + out("zh.exr"));
    EXPECT_EQ(zonal.exit_code, 0) << zonal.err;
    EXPECT_THAT(zonal.out, HasSubstr("fitted, 0.23 %"));
    const ProgramResult exact = dermis("bake lut --size 32 --profile openpbr_skin_5 -o " + out("exact.exr"));
    EXPECT_EQ(exact.out.find("fitted"), std::string::npos) << exact.out;
}
