// The report as people use it: in a browser. Needs chromium and node (tools/apt_checks.txt); passed over
// without.

#include <algorithm>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/judge/report.h"
#include "render/render_test.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

class Page : public RenderTest {};

std::string first_program(std::initializer_list<const char*> names) {
    const auto found = std::ranges::find_if(names, has_program);
    return found == names.end() ? "" : *found;
}

}  // namespace

TEST_F(Page, opens_in_a_browser_and_the_picture_follows_the_slider) {
    const std::string chromium = first_program({"chromium", "chromium-browser", "google-chrome"});
    const std::string node = first_program({"node", "nodejs"});
    if (chromium.empty() || node.empty()) GTEST_SKIP() << "no chromium or no node here";
    const Scene scene = load("builtin:spheres");
    ComparisonSettings settings = comparison_settings(96, 96);
    settings.frames = 1;
    settings.grid = 2;
    settings.samples = 8;
    settings.probes = 8;
    const auto contestants = parse_technique_list(built_in_catalog().techniques, "lambert,wrap");
    ASSERT_TRUE(contestants);
    const auto comparison = compare_techniques(device(), built_in_catalog(), scene, *contestants, settings);
    ASSERT_TRUE(comparison) << comparison.error().message;
    const auto page = report_html(scene, *comparison, settings);
    ASSERT_TRUE(page) << page.error().message;

    const TemporaryDirectory directory;
    const auto path = [&](const char* name) { return (directory.path / name).string(); };
    const auto check = [&](const std::string& text) {
        EXPECT_TRUE(write_text_file(path("report.html"), text));
        return run_shell(node + " " DERMIS_SOURCE_DIR "/tools/checks/page.mjs " + chromium + " " +
                             path("report.html") + " " + path("page.png"),
                         directory.path.string());
    };
    const ProgramResult good = check(*page);
    EXPECT_EQ(good.exit_code, 0) << good.err;
    EXPECT_TRUE(std::filesystem::exists(path("page.png")));

    // Proof that the check can fail: a page whose pictures ignore the slider.
    std::string broken = *page;
    const std::string line = "$(\"left\").style.clipPath";
    ASSERT_NE(broken.find(line), std::string::npos);
    broken.replace(broken.find(line), line.size(), "$(\"left\").style.order");
    const ProgramResult bad = check(broken);
    EXPECT_NE(bad.exit_code, 0);
    EXPECT_THAT(bad.err, testing::HasSubstr("does not follow the slider"));
}
