// Skins as MaterialX and glTF in programs that are not ours: MaterialX itself and the Khronos validator (each
// from npm), and three.js in headless Chromium. Needs chromium, node, and `npm ci` in tools/checks; passed
// over without.

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "dermis/optics/burley_scaling.h"
#include "dermis/optics/gltf_profile.h"
#include "dermis/optics/presets.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kChecks = DERMIS_SOURCE_DIR "/tools/checks";
constexpr const char* kSkin = "openpbr_skin_5";

class Interchange : public testing::Test {
  protected:
    bool has(const std::string& package) const {
        return has_program("node") && fs::exists(kChecks + "/node_modules/" + package);
    }
    std::string path(const char* name) const { return (directory_.path / name).string(); }
    void dermis(const std::string& arguments) const {
        const ProgramResult done =
            run_shell(std::string(DERMIS_PROGRAM) + " " + arguments, directory_.path.string());
        ASSERT_EQ(done.exit_code, 0) << done.err;
    }
    json said_by(const std::string& script, const std::string& arguments) const {
        const ProgramResult done =
            run_shell("node " + kChecks + "/" + script + " " + arguments, directory_.path.string());
        EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
        const json said = json::parse(done.out, nullptr, false);
        EXPECT_FALSE(said.is_discarded()) << done.out;
        return said;
    }

    TemporaryDirectory directory_;
};

Rgb numbers_of(const json& input) {
    std::istringstream text(input["value"].get<std::string>());
    Rgb numbers = {};
    char comma = 0;
    for (double& number : numbers) text >> number >> comma;
    return numbers;
}

TEST_F(Interchange, materialx_reads_the_skin_as_it_was_meant) {
    if (!has("@needle-tools/materialx")) GTEST_SKIP() << "needs node, and 'npm ci' in tools/checks";
    ASSERT_NO_FATAL_FAILURE(dermis(std::string("profile convert ") + kSkin + " -o " + path("skin.mtlx")));
    const json found = said_by("read_mtlx.mjs", path("skin.mtlx"));
    EXPECT_TRUE(found["valid"]) << found.dump();
    EXPECT_TRUE(found["generates"]) << found.dump();
    const json& inputs = found["inputs"];
    const Profile skin = *find_profile(kSkin);
    const Rgb color = numbers_of(inputs["subsurface_color"]),
              scale = numbers_of(inputs["subsurface_radius_scale"]);
    EXPECT_EQ(inputs["subsurface_color"]["colorSpace"], "lin_rec709");
    EXPECT_EQ(inputs["subsurface_radius"]["unit"], "centimeter");
    const double radius_cm = std::stod(inputs["subsurface_radius"]["value"].get<std::string>());
    for (int c = 0; c < 3; ++c) {
        const double albedo = diffuse_albedo(skin, c), d_mm = mean_radius_mm(skin, c) / 2.5;
        EXPECT_NEAR(color[size_t(c)], albedo, 1e-7);
        EXPECT_NEAR(10 * radius_cm * scale[size_t(c)], d_mm * mean_free_path_per_d(albedo), 1e-6);
    }
    // The check can fail: an input of another type.
    std::string text = *read_text_file(path("skin.mtlx"));
    const size_t type = text.find("\"float\"");
    ASSERT_NE(type, std::string::npos);
    ASSERT_TRUE(write_text_file(path("wrong.mtlx"), text.replace(type, 7, "\"color3\"")));
    EXPECT_FALSE(said_by("read_mtlx.mjs", path("wrong.mtlx"))["valid"]);
}

TEST_F(Interchange, the_khronos_validator_finds_nothing_wrong_in_a_head) {
    if (!has("gltf-validator")) GTEST_SKIP() << "needs node, and 'npm ci' in tools/checks";
    ASSERT_NO_FATAL_FAILURE(
        dermis(std::string("export-mesh builtin:bust --profile ") + kSkin + " -o " + path("head.glb")));
    const json found = said_by("validate_gltf.mjs", path("head.glb"));
    EXPECT_THAT(found["errors"], IsEmpty()) << found["errors"].dump();
    EXPECT_THAT(found["warnings"], IsEmpty()) << found["warnings"].dump();
    for (const json& note : found["notes"])  // what it does not know yet: drafts
        EXPECT_THAT(note.get<std::string>(), HasSubstr("UNSUPPORTED_EXTENSION"));
    // The check can fail: a distance below 0.
    std::string file = *read_text_file(path("head.glb"));
    const size_t key = file.find("\"attenuationDistance\":0");
    ASSERT_NE(key, std::string::npos);
    ASSERT_TRUE(write_text_file(path("wrong.glb"), file.replace(key + 22, 1, "-")));
    EXPECT_THAT(said_by("validate_gltf.mjs", path("wrong.glb"))["errors"], testing::Not(IsEmpty()));
}

// More red than green, more green than blue.
bool is_skin_colored(const Image& picture, int x, int y) {
    return picture.at(x, y, 0) > 1.1f * picture.at(x, y, 1) &&
           picture.at(x, y, 1) > 1.1f * picture.at(x, y, 2);
}

TEST_F(Interchange, three_js_reads_and_draws_both) {
    std::string browser;
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
        if (browser.empty() && has_program(name)) browser = name;
    if (browser.empty() || !has("three")) GTEST_SKIP() << "needs chromium, and 'npm ci' in tools/checks";
    fs::create_directory(path("page"));
    for (const char* file : {"interchange.html", "interchange.js"})
        fs::copy_file(std::string(DERMIS_SOURCE_DIR "/tests/engines/hosts/") + file,
                      directory_.path / "page" / file);
    fs::create_directory_symlink(kChecks + "/node_modules", path("node_modules"));
    ASSERT_NO_FATAL_FAILURE(
        dermis(std::string("profile convert ") + kSkin + " -o " + path("page/skin.mtlx")));
    ASSERT_NO_FATAL_FAILURE(
        dermis(std::string("export-mesh builtin:bust --profile ") + kSkin + " -o " + path("page/head.glb")));
    const json pages = said_by("host_picture.mjs", browser + " " + directory_.path.string() +
                                                       " 320 page/interchange.html " + path("drawn.png"));
    ASSERT_EQ(pages[0]["said"].size(), 1) << "no warnings on its console: " << pages.dump();
    const json found = json::parse(pages[0]["said"][0].get<std::string>(), nullptr, false);
    ASSERT_TRUE(found.is_object()) << pages.dump();
    const GltfVolume volume = gltf_volume(*find_profile(kSkin), {});
    for (size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(found["gltf"]["color"][c].get<double>(), volume.attenuation_color[c], 1e-6);
    EXPECT_NEAR(found["gltf"]["distance_m"].get<double>(), volume.attenuation_distance_m, 1e-9);
    EXPECT_TRUE(found["gltf"]["map"]);
    EXPECT_EQ(found["gltf"]["profile"], "burley");
    // three.js has no subsurface in OpenPBR, and says so; the base's colour is drawn in its place.
    for (const json& input : found["ignored"])
        EXPECT_THAT(input.get<std::string>(), testing::StartsWith("subsurface_"));
    const Image picture = read_image(path("drawn.png"), ImageUse::color)->image;
    EXPECT_TRUE(is_skin_colored(picture, 80, 130)) << "the sphere with the document's material";
    EXPECT_TRUE(is_skin_colored(picture, 240, 190)) << "the head";
    EXPECT_EQ(picture.at(10, 10, 0), picture.at(10, 10, 2)) << "and not the page";
}

}  // namespace
}  // namespace dermis
