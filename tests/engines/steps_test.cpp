// The six steps of each package's README: every line of code that can run here is run. Needs chromium, node
// and `npm ci` in tools/checks for the lines of JavaScript, python3 for Unreal's; passed over without them.
// Lines of npm need a network and are not run; head_test.cpp runs Godot's.

#include <gmock/gmock.h>

#include <filesystem>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "engines/readme_steps.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis::readme_steps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModules = DERMIS_SOURCE_DIR "/tools/checks/node_modules";
constexpr int kSide = 128;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

class ReadmeSteps : public testing::TestWithParam<const char*> {
  protected:
    ProgramResult shell(const std::string& command) {
        return run_shell("cd " + directory_.path.string() + " && " + command, directory_.path.string());
    }
    // Step 1 with the built-in head; the folder that it writes.
    fs::path export_package() {
        const std::string readme = readme_of(GetParam()), line = lines_with(readme, "dermis export ").front();
        const ProgramResult made = shell(DERMIS_PROGRAM + replaced(line.substr(6), "head.glb", "bust"));
        EXPECT_EQ(made.exit_code, 0) << line << ": " << made.err;
        const std::string folder = line.substr(line.rfind("-o ") + 3);
        EXPECT_TRUE(folder.ends_with("/")) << line;
        return directory_.path / folder.substr(0, folder.size() - 1);
    }
    // A page that runs this script.
    void write_page(const fs::path& package, const std::string& name, const std::string& script) {
        const std::string engine = GetParam();
        std::string page = *read_text_file(package / "head/index.html");
        page = replaced(page, "\"imports\": {", "\"imports\": { \"dermis-skin-" + engine + "/\": \"../\",");
        page = replaced(page, "head.js", name + ".js");
        EXPECT_TRUE(write_text_file(package / "steps" / (name + ".html"), page));
        EXPECT_TRUE(
            write_text_file(package / "steps" / (name + ".js"),
                            "window.onunhandledrejection = ({ reason }) => {\n"
                            "  document.getElementById(\"message\").textContent = reason.message;\n};\n" +
                                script + "\ndocument.body.dataset.state = \"drawn\";\n"));
    }

    TemporaryDirectory directory_;
};

const auto kName = [](const auto& one) { return std::string(one.param); };

TEST_P(ReadmeSteps, are_six_and_the_first_one_exports) {
    const std::string readme = readme_of(GetParam());
    for (int i = 1; i <= 7; ++i)
        EXPECT_EQ(readme.find("\n" + std::to_string(i) + ". ") != std::string::npos, i <= 6) << i;
    const fs::path package = export_package();
    EXPECT_TRUE(fs::exists(package / "README.md")) << package;
}
INSTANTIATE_TEST_SUITE_P(, ReadmeSteps, testing::Values("three", "babylon", "godot", "unreal"), kName);

// The brightest channel of the middle of the picture, which is skin.
float middle_of(const fs::path& picture) {
    const auto drawn = read_image(picture, ImageUse::color);
    return drawn ? drawn->image.at(kSide / 2, kSide / 2, 0) : 0.0f;
}

class BrowserSteps : public ReadmeSteps {};
INSTANTIATE_TEST_SUITE_P(, BrowserSteps, testing::Values("three", "babylon"), kName);

TEST_P(BrowserSteps, draw_the_head_in_a_page_and_a_line_that_is_left_out_is_found) {
    if (!has_program("chromium") || !has_program("node") || !fs::exists(kModules))
        GTEST_SKIP() << "no chromium, no node or no modules here: npm ci in tools/checks";
    const fs::path package = export_package();
    fs::create_directory_symlink(kModules, package / "node_modules");
    const std::string steps = script_of(readme_of(GetParam()));
    const std::string load = GetParam() == std::string("three") ? "addSkinHead(scene, head);\n"
                                                                : "placeSkinCamera(camera, head.settings);\n";
    ASSERT_THAT(steps, testing::HasSubstr(load));
    write_page(package, "whole", steps);
    write_page(package, "partial", replaced(steps, load, ""));
    const ProgramResult drawn =
        shell("node " DERMIS_SOURCE_DIR "/tools/checks/host_picture.mjs chromium " + package.string() + " " +
              std::to_string(kSide) + " steps/whole.html whole.png steps/partial.html partial.png");
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_THAT(drawn.out, testing::HasSubstr(R"("said":[],"picture":true)"));
    EXPECT_GT(middle_of(directory_.path / "whole.png"), 0.3f) << drawn.out;
    EXPECT_LT(middle_of(directory_.path / "partial.png"), 0.2f);
}

}  // namespace
}  // namespace dermis::readme_steps
