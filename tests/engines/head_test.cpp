// A scene's head in three.js and Babylon.js, in headless Chromium on WebGL 2 and WebGPU, held against the
// reference beside Dermis' own picture. Needs chromium, node, and `npm ci` in tools/checks; passed over
// without them.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "dermis/image/io.h"
#include "dermis/image/resample.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

namespace fs = std::filesystem;

constexpr const char* kBrowserModules = DERMIS_SOURCE_DIR "/tools/checks/node_modules";

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
        export_head();
    }
    ProgramResult shell(const std::string& command) { return run_shell(command, directory_.path.string()); }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    // The exported page, with the script of a test in place of its own.
    void export_head() {
        const std::string engine = GetParam();
        const fs::path hosts = DERMIS_SOURCE_DIR "/tests/engines/hosts";
        const ProgramResult made =
            shell(DERMIS_PROGRAM " export --engine " + engine + " bust -o " + path("package"));
        ASSERT_EQ(made.exit_code, 0) << made.err;
        fs::create_directory_symlink(kBrowserModules, path("package/node_modules"));
        fs::create_directory(path("package/test"));
        fs::copy_file(path("package/head/index.html"), path("package/test/index.html"));
        fs::copy_file(hosts / (engine + "_head.js"), path("package/test/head.js"));
        fs::copy_file(hosts / "floats.js", path("package/test/floats.js"));
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
    Image rendered(const std::string& gain) {
        const ProgramResult made =
            shell(DERMIS_PROGRAM " render bust --technique preintegrated --size 144 --set gain=" + gain +
                  " -o " + path(gain + ".exr"));
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return resize(read(gain), 48, 48);
    }
    Image read(const std::string& name) {
        const auto picture = read_image(path(name + ".exr"), ImageUse::color);
        EXPECT_TRUE(picture) << picture.error().message;
        return picture ? to_linear_float(picture->image) : Image(48, 48, 3);
    }

    TemporaryDirectory directory_;
};

INSTANTIATE_TEST_SUITE_P(, HeadPackage, testing::Values("three", "babylon"),
                         [](const auto& one) { return std::string(one.param); });

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

TEST_P(HeadPackage, has_the_renderers_share_and_a_mistake_loses_it) {
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
    const Image gain = change(rendered("curvature"), rendered("none")), nothing(48, 48, 3);
    for (const char* device : {"webgl", "webgpu"})
        EXPECT_LT(distance(change(read(device + std::string("_gain")), read(device)), gain),
                  0.2 * distance(gain, nothing))
            << device;
    const ProgramResult srgb = draw({{"srgb", "webgl&mistake=srgb"}});
    EXPECT_EQ(srgb.exit_code, 1);
    EXPECT_NE(srgb.err.find("they hold directions, not colours"), std::string::npos) << srgb.err;
    for (const auto& [name, value] : share) RecordProperty(name, std::to_string(value));
}
