// A scene's head in three.js, in headless Chromium on WebGL 2, held against the reference beside Dermis' own
// picture. Needs chromium, node, and `npm ci` in tools/checks; passed over without them.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

namespace fs = std::filesystem;

constexpr const char* kBrowserModules = DERMIS_SOURCE_DIR "/tools/checks/node_modules";

class HeadPackage : public testing::Test {
  protected:
    void SetUp() override {
        if (!has_program("chromium") || !has_program("node")) GTEST_SKIP() << "no chromium or no node here";
        if (!fs::exists(kBrowserModules)) GTEST_SKIP() << "no three here: npm ci in tools/checks";
    }
    ProgramResult shell(const std::string& command) { return run_shell(command, directory_.path.string()); }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    // The exported page, with the script of a test in place of its own.
    void export_head() {
        const ProgramResult made = shell(DERMIS_PROGRAM " export --engine three bust -o " + path("package"));
        ASSERT_EQ(made.exit_code, 0) << made.err;
        fs::create_directory_symlink(kBrowserModules, path("package/node_modules"));
        fs::create_directory(path("package/test"));
        fs::copy_file(path("package/head/index.html"), path("package/test/index.html"));
        fs::copy_file(DERMIS_SOURCE_DIR "/tests/engines/hosts/three_head.js", path("package/test/head.js"));
    }
    // Linear pictures by the name of what the page's query adds.
    ProgramResult draw(const std::vector<std::string>& queries) {
        std::string jobs;
        for (const std::string& query : queries)
            jobs += " 'test/index.html?side=48&points=4&webgl&" + query + "' " + path(query + ".exr");
        return shell("node " DERMIS_SOURCE_DIR "/tools/checks/host_floats.mjs chromium " + path("package") +
                     jobs);
    }
    // The captured share against `surface` of each row.
    std::map<std::string, double> shares(const std::vector<std::string>& queries) {
        std::string command = DERMIS_PROGRAM
                              " compare bust --size 48 --samples-per-pixel 16 --integrator surface "
                              "--timed-frames 1 -t preintegrated "
                              "--json -o " +
                              path("report");
        for (const std::string& query : queries) {
            const std::string name = query.substr(query.find('=') + 1);
            command += " --picture " + name + "=" + path(query + ".exr") + "," + path("lambert.exr");
        }
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

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(HeadPackage, in_three_js_has_most_of_the_renderers_share_and_a_mistake_loses_it) {
    ASSERT_NO_FATAL_FAILURE(export_head());
    const std::vector<std::string> queries = {"mistake=none", "mistake=normals", "mistake=curvature"};
    const ProgramResult drawn = draw({"lambert", queries[0], queries[1], queries[2]});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const std::map<std::string, double> share = shares(queries);
    ASSERT_EQ(share.size(), 4u);
    EXPECT_GT(share.at("none"), 0.75 * share.at("preintegrated"));
    EXPECT_LT(share.at("normals"), share.at("none") - 0.1);
    EXPECT_LT(share.at("curvature"), share.at("none") - 0.1);
    const ProgramResult srgb = draw({"mistake=srgb"});
    EXPECT_EQ(srgb.exit_code, 1);
    EXPECT_NE(srgb.err.find("has to be NoColorSpace"), std::string::npos) << srgb.err;
}
