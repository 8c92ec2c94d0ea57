#include "dermis/judge/scoreboard.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "dermis/base/file.h"
#include "render/render_test.h"
#include "test_paths.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

class Scoreboards : public RenderTest {};

ScoreboardRow row(const std::string& scene, const std::string& technique, double rmse) {
    ScoreboardRow r{
        .row = {.scene = scene, .technique = technique}, .time_ratio = 1.25, .reference_rmse = 1e-3};
    r.row.scores.rmse = rmse;
    r.row.scores.penumbra_rmse = 0.5;
    return r;
}

// Errors that were measured when the techniques were last right; DERMIS_UPDATE_SCORES=1 records them anew.
constexpr const char* kRecorded = DERMIS_SOURCE_DIR "/tests/judge/recorded_scores.csv";
// Drivers round differently from one CPU to another.
constexpr double kTolerance = 0.03, kAbsoluteTolerance = 2e-4;

ComparisonSettings small() {
    ComparisonSettings settings = comparison_settings(80, 80);
    settings.shadow_map_size = 2048;
    settings.frames = 0;
    settings.reference.samples = 8;
    settings.reference.noise = {};
    return settings;
}

}  // namespace

TEST(Scoreboard, survives_its_own_file_and_keeps_the_rows_of_other_scenes) {
    ScoreboardRow quoted = row("spheres", "wrap", 0.25);
    quoted.row.settings = "wrap=0.4,specular=ggx";
    const std::vector<ScoreboardRow> rows = {row("bust", "lambert", 0.5), quoted};
    const std::string text = scoreboard_csv(rows);
    const auto again = parse_scoreboard(text);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(scoreboard_csv(*again), text);
    EXPECT_EQ((*again)[1].row.settings, quoted.row.settings);
    EXPECT_FALSE((*again)[1].row.scores.terminator_rmse.has_value());
    const auto both = merged(*again, {row("bust", "lambert", 0.125)});
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[0].row.scene, "spheres");
    EXPECT_EQ(both[1].row.scores.rmse, 0.125);
}

TEST(Scoreboard, a_file_that_is_no_scoreboard_is_named_by_line) {
    const std::string good = scoreboard_csv({row("bust", "lambert", 0.5)});
    EXPECT_THAT(parse_scoreboard("a,b\n").error().message, HasSubstr("line 1"));
    EXPECT_THAT(parse_scoreboard(good + "bust,wrap\n").error().message, HasSubstr("line 3: has 2 columns"));
    std::string bad = good;
    bad.replace(bad.rfind("0.5"), 3, "x");
    EXPECT_THAT(parse_scoreboard(bad).error().message, HasSubstr("is no number"));
    bad.replace(bad.rfind(",x,") + 1, 1, "nan");  // what could not be sorted
    EXPECT_THAT(parse_scoreboard(bad).error().message, HasSubstr("is not finite"));
}

TEST(Scoreboard, the_table_is_sorted_by_error_and_the_plot_has_a_panel_a_scene) {
    const std::vector<ScoreboardRow> rows = {row("bust", "wrap", 0.5), row("bust", "lambert", 0.25),
                                             row("spheres", "wrap", 0.1)};
    const std::string text = scoreboard_markdown(rows);
    EXPECT_LT(text.find("`lambert`"), text.find("`wrap`"));
    EXPECT_EQ(scoreboard_plot(rows).panels.size(), 2u);
}

TEST(Scoreboard, all_it_lists_can_be_set) {
    EXPECT_GT(scoreboard_contestants().size(), all_techniques().size());
}

TEST_F(Scoreboards, no_technique_is_worse_than_it_was) {
    std::vector<ScoreboardRow> made;
    for (const char* name : {"spheres", "bust"}) {
        const Scene scene = load(name);
        std::vector<Contestant> list = default_contestants();
        const auto more = parse_technique_list(
            "preintegrated[diffuse=closed_form,shadow=plain],preintegrated[diffuse=curve_2015,shadow=plain]");
        ASSERT_TRUE(more) << more.error().message;
        list.insert(list.end(), more->begin(), more->end());
        const auto comparison = compare_techniques(device(), scene, list, small());
        ASSERT_TRUE(comparison) << comparison.error().message;
        for (ScoreboardRow& r : scoreboard_rows(name, *comparison)) made.push_back(std::move(r));
    }
    if (std::getenv("DERMIS_UPDATE_SCORES")) {
        ASSERT_TRUE(write_text_file(kRecorded, scoreboard_csv(made)));
        GTEST_SKIP() << "recorded anew";
    }
    const auto text = read_text_file(kRecorded);
    ASSERT_TRUE(text) << text.error().message;
    const auto recorded = parse_scoreboard(*text);
    ASSERT_TRUE(recorded) << recorded.error().message;
    for (const ScoreboardRow& now : made) {
        const auto before = std::ranges::find_if(*recorded, [&](const ScoreboardRow& r) {
            return r.row.scene == now.row.scene && r.row.technique == now.row.technique &&
                   r.row.settings == now.row.settings;
        });
        const std::string name = now.row.scene + ", " + now.row.technique + " " + now.row.settings;
        if (before == recorded->end()) {
            ADD_FAILURE() << name << " has no recorded error; run with DERMIS_UPDATE_SCORES=1";
            continue;
        }
        const Scores &a = now.row.scores, &b = before->row.scores;
        const auto most = [](double value) { return value * (1 + kTolerance) + kAbsoluteTolerance; };
        EXPECT_LE(a.rmse, most(b.rmse)) << name;
        EXPECT_LE(a.terminator_rmse.value_or(0), most(b.terminator_rmse.value_or(0)))
            << name << ", terminator";
        EXPECT_LE(a.penumbra_rmse.value_or(0), most(b.penumbra_rmse.value_or(0))) << name << ", penumbra";
        EXPECT_LE(a.flip, most(b.flip)) << name << ", FLIP";
    }
}
