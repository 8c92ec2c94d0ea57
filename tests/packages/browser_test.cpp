// The packages for browsers in the engine itself: their example, a sphere of 8 mm, in headless Chromium
// against the renderer's own picture. Needs chromium, node, and `npm ci` in tools/checks; passed over
// without.

#include <gmock/gmock.h>

#include <filesystem>
#include <ostream>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "packages/packages.h"
#include "support/sphere_pictures.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kProfile = "openpbr_skin_5";
constexpr int kSide = 320, kMinPixels = 50'000;

struct Host {
    const char* engine;
    const char* library;  // in node_modules
    const char* device;   // webgl or webgpu: the example's query
};

// Without it GoogleTest prints the bytes, which are addresses.
void PrintTo(const Host& host, std::ostream* out) {
    *out << host.engine << " on " << host.device;
}

std::string chromium() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
        if (has_program(name)) return name;
    return "";
}

class BrowserPackage : public testing::TestWithParam<Host> {
  protected:
    void SetUp() override {
        const fs::path modules = DERMIS_SOURCE_DIR "/tools/checks/node_modules";
        if (chromium().empty() || !has_program("node")) GTEST_SKIP() << "no chromium or no node here";
        if (!fs::exists(modules / GetParam().library))
            GTEST_SKIP() << "no " << GetParam().library << " here: npm ci in tools/checks";
        for (const auto& [path, text] : package_of(GetParam().engine, kProfile))
            ASSERT_TRUE(write_text_file(folder_ / path, text)) << path;
        fs::create_directory_symlink(modules, folder_ / "node_modules");
        const std::string size = std::to_string(kSide) + "x" + std::to_string(kSide);
        const ProgramResult drawn =
            run_shell(std::string(DERMIS_PROGRAM) +
                          " render " DERMIS_SOURCE_DIR
                          "/tests/packages/sphere_8mm.toml --technique preintegrated --set "
                          "specular=two_lobe_ggx --set transmission=none --size " +
                          size + " -o " + (directory_.path / "ours.png").string(),
                      directory_.path.string());
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        ours_ = read_image(directory_.path / "ours.png", ImageUse::color)->image;
    }

    // The example's picture; empty where the browser has not this device. `said_`: messages, a line each.
    Image picture(const std::string& query = "") {
        const fs::path path = directory_.path / "theirs.png";
        const ProgramResult shot =
            run_shell("node " DERMIS_SOURCE_DIR "/tools/checks/host_picture.mjs " + chromium() + " " +
                          folder_.string() + " 'example/index.html?" + GetParam().device + query + "' " +
                          path.string() + " " + std::to_string(kSide),
                      directory_.path.string());
        said_ = shot.out;
        if (shot.exit_code == 3) return {};
        EXPECT_EQ(shot.exit_code, 0) << shot.out << shot.err;
        return shot.exit_code == 0 ? read_image(path, ImageUse::color)->image : Image();
    }

    void replace(const std::string& path, const std::string& from, const std::string& to) {
        std::string text = read_text_file(folder_ / path).value();
        ASSERT_NE(text.find(from), std::string::npos) << path << " has no " << from;
        for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
            text.replace(at, from.size(), to);
        ASSERT_TRUE(write_text_file(folder_ / path, text));
    }

    TemporaryDirectory directory_;
    fs::path folder_ = directory_.path / "package";
    Image ours_;
    std::string said_;
};

TEST_P(BrowserPackage, draws_a_sphere_of_8_mm_as_the_renderer_does) {
    for (const char* query : {"", "&closed"}) {
        const Image theirs = picture(query);
        if (said_.starts_with("this browser has no")) GTEST_SKIP() << said_;
        EXPECT_EQ(said_, "") << query;
        ASSERT_EQ(theirs.width, kSide);
        const SphereDifference difference = sphere_difference(ours_, theirs);
        EXPECT_GT(difference.pixels, kMinPixels);
        EXPECT_LE(difference.largest_level, 2) << query;
    }
}

// The check can fail: a table that is read two hundredths beside its place, in both languages' text.
TEST_P(BrowserPackage, with_a_mistake_in_its_shader_does_not) {
    replace("skin.js", "n_dot_l * 0.5 + 0.5", "n_dot_l * 0.5 + 0.48");
    const Image theirs = picture();
    if (said_.starts_with("this browser has no")) GTEST_SKIP() << said_;
    ASSERT_EQ(theirs.width, kSide);
    EXPECT_GT(sphere_difference(ours_, theirs).largest_level, 4);
}

// White letters on what is nearly black, and a sentence on the console.
TEST_P(BrowserPackage, says_in_words_what_is_missing) {
    for (const std::string missing : {"table", "curvature"}) {
        const Image theirs = picture("&missing=" + missing);
        if (said_.starts_with("this browser has no")) GTEST_SKIP() << said_;
        EXPECT_THAT(said_, HasSubstr(missing));
        ASSERT_EQ(theirs.width, kSide);
        int white = 0, dark = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                white += theirs.at(x, y, 0) > 0.99f && theirs.at(x, y, 2) > 0.99f;
                dark += theirs.at(x, y, 0) < 0.2f && theirs.at(x, y, 1) < 0.2f;
            }
        // The T of both texts, upright: its bar at the top.
        EXPECT_GT(theirs.at(129, 145, 0), 0.99f) << missing;
        EXPECT_LT(theirs.at(129, 161, 0), 0.2f) << missing;
        EXPECT_GT(theirs.at(133, 161, 0), 0.99f) << missing;
        EXPECT_GT(white, kSide * kSide / 20) << missing;
        EXPECT_GT(white + dark, kSide * kSide * 97 / 100) << missing;
    }
}

// A table that cannot be read is said by the example's page.
TEST_P(BrowserPackage, says_which_file_is_missing) {
    for (const char* table : {"skin_table.exr", "skin_table.dds"}) fs::remove(folder_ / table);
    const Image theirs = picture();
    if (said_.starts_with("this browser has no")) GTEST_SKIP() << said_;
    EXPECT_THAT(said_, HasSubstr("/skin_table."));
}

INSTANTIATE_TEST_SUITE_P(Hosts, BrowserPackage,
                         testing::Values(Host{"three", "three", "webgl"}, Host{"three", "three", "webgpu"},
                                         Host{"babylon", "@babylonjs/core", "webgl"},
                                         Host{"babylon", "@babylonjs/core", "webgpu"}),
                         [](const auto& one) {
                             return std::string(one.param.engine) + "_" + one.param.device;
                         });

}  // namespace
}  // namespace dermis
