#include "dermis/judge/scoreboard.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "dermis/base/file.h"
#include "render/render_test.h"
#include "support/built_in.h"
#include "test_paths.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

class Scoreboards : public RenderTest {};

ScoreRow row(const std::string& scene, const std::string& technique, double share) {
    ScoreRow r{.scene = scene, .technique = technique, .time_ratio = 1.25, .reference_rmse = 1e-3};
    r.captured.all.share = share;
    r.scores.penumbra_rmse = 0.5;
    return r;
}

// Shares of the last accepted measurement; DERMIS_UPDATE_SCORES=1 records them again,
// =missing those alone that have no record.
constexpr const char* kRecorded = DERMIS_SOURCE_DIR "/tests/judge/recorded_scores.csv";
// Drivers round differently from one CPU to another.
constexpr double kTolerance = 0.02;

ComparisonSettings small() {
    ComparisonSettings settings = comparison_settings(64, 64);
    settings.grid = 3;
    settings.samples = 720;
    settings.noise = 0.13;
    settings.probes = 16;
    settings.shadow_map_size = 2048;
    settings.frames = 0;
    return settings;
}

std::vector<ScoreRow> with_missing(std::vector<ScoreRow> recorded, const std::vector<ScoreRow>& made) {
    for (const ScoreRow& row : made)
        if (std::ranges::none_of(recorded, [&](const ScoreRow& r) {
                return r.scene == row.scene && r.technique == row.technique && r.settings == row.settings;
            }))
            recorded.push_back(row);
    return recorded;
}

}  // namespace

TEST(Scoreboard, survives_its_own_file_and_keeps_the_rows_of_other_scenes) {
    ScoreRow quoted = row("spheres", "wrap", 0.25);
    quoted.settings = "wrap=0.4,specular=ggx";
    const std::vector<ScoreRow> rows = {row("bust", "lambert", 0.5), quoted};
    const std::string text = scores_csv(rows);
    const auto again = parse_scores(text);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(scores_csv(*again), text);
    EXPECT_EQ((*again)[1].settings, quoted.settings);
    EXPECT_FALSE((*again)[1].scores.terminator_rmse.has_value());
    const auto both = merged(*again, {row("bust", "lambert", 0.125)});
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[0].scene, "spheres");
    EXPECT_EQ(both[1].captured.all.share, 0.125);
}

TEST(Scoreboard, a_file_that_is_no_scoreboard_is_named_by_line) {
    const std::string good = scores_csv({row("bust", "lambert", 0.5)});
    EXPECT_THAT(parse_scores("a,b\n").error().message, HasSubstr("line 1"));
    EXPECT_THAT(parse_scores(good + "bust,wrap\n").error().message, HasSubstr("line 3: has 2 columns"));
    std::string bad = good;
    bad.replace(bad.rfind("0.5"), 3, "x");
    EXPECT_THAT(parse_scores(bad).error().message, HasSubstr("is no number"));
    bad.replace(bad.rfind(",x,") + 1, 1, "nan");  // what could not be sorted
    EXPECT_THAT(parse_scores(bad).error().message, HasSubstr("is not finite"));
}

TEST(Scoreboard, the_table_is_sorted_by_captured_share_and_the_plot_has_a_panel_a_scene) {
    const std::vector<ScoreRow> rows = {row("bust", "wrap", -0.5), row("bust", "lambert", 0),
                                        row("spheres", "wrap", 0.1)};
    const std::string text = scoreboard_markdown(rows);
    EXPECT_LT(text.find("`lambert`"), text.find("`wrap`"));
    EXPECT_EQ(scoreboard_plot(rows).panels.size(), 2u);
}

TEST(Scoreboard, all_it_lists_can_be_set) {
    EXPECT_GT(scoreboard_contestants(built_in_catalog().techniques).size(),
              built_in_catalog().techniques.size());
}

TEST_F(Scoreboards, rows_that_are_recorded_stay_when_the_missing_are_added) {
    ScoreRow old, added;
    old.scene = added.scene = "spheres";
    old.technique = "lambert";
    old.scores.flip = 1;
    added.technique = "my_skin";
    ScoreRow old_again = old;
    old_again.scores.flip = 2;
    const std::vector<ScoreRow> rows = with_missing({old}, {old_again, added});
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].scores.flip, 1);
    EXPECT_EQ(rows[1].technique, "my_skin");
}

TEST_F(Scoreboards, no_technique_captures_less_than_it_did) {
    std::vector<ScoreRow> made;
    for (const char* name : {"spheres", "bust"}) {
        const Scene scene = load(name);
        std::vector<Contestant> list = default_contestants(built_in_catalog().techniques);
        const auto more = parse_technique_list(
            built_in_catalog().techniques,
            "preintegrated[diffuse=closed_form,shadow=plain],preintegrated[diffuse=curve_2015,shadow=plain]");
        ASSERT_TRUE(more) << more.error().message;
        list.insert(list.end(), more->begin(), more->end());
        const auto comparison = compare_techniques(device(), built_in_catalog(), scene, list, small());
        ASSERT_TRUE(comparison) << comparison.error().message;
        for (ScoreRow& r : score_rows(name, *comparison)) made.push_back(std::move(r));
    }
    const auto text = read_text_file(kRecorded);
    ASSERT_TRUE(text) << text.error().message;
    const auto recorded = parse_scores(*text);
    ASSERT_TRUE(recorded) << recorded.error().message;
    if (const char* update = std::getenv("DERMIS_UPDATE_SCORES")) {
        const bool missing_only = std::string_view(update) == "missing";
        ASSERT_TRUE(
            write_text_file(kRecorded, scores_csv(missing_only ? with_missing(*recorded, made) : made)));
        GTEST_SKIP() << "recorded again";
    }
    for (const ScoreRow& now : made) {
        const auto before = std::ranges::find_if(*recorded, [&](const ScoreRow& r) {
            return r.scene == now.scene && r.technique == now.technique && r.settings == now.settings;
        });
        const std::string name = now.scene + ", " + now.technique + " " + now.settings;
        if (before == recorded->end()) {
            ADD_FAILURE() << name << " has no recorded share; run with DERMIS_UPDATE_SCORES=1";
            continue;
        }
        EXPECT_TRUE(now.captured.all.known()) << name;
        const double a = now.captured.all.share, b = before->captured.all.share;
        EXPECT_GE(a, b - kTolerance * std::max(1.0, 1 - b)) << name;
        EXPECT_LE(now.scores.flip, before->scores.flip * 1.03 + 2e-4) << name << ", FLIP";
    }
}
