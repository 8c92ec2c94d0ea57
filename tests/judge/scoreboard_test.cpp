#include "dermis/judge/scoreboard.h"
#include "dermis/render/complete_scene.h"

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
    r.surface.emplace().all.share = share;
    r.scores.penumbra_rmse = 0.5;
    return r;
}

// Shares of the last accepted measurement; DERMIS_UPDATE_SCORES=1 records them again,
// =missing those alone that have no record.
constexpr const char* kRecorded = DERMIS_SOURCE_DIR "/tests/judge/recorded_scores.csv";
// Drivers round differently from one CPU to another.
constexpr double kTolerance = 0.02;
// FLIP over the recorded one, which is of Mesa 22's lavapipe. Transmission's taps read the shadow map's
// nearest texel, and another driver's rounding takes the next one: with Mesa 25 unit/cylinder of
// screen_space_separable has 1.10 times the FLIP; without transmission its picture is the same.
constexpr double kFlipRise = 1.03, kFlipRiseOfOtherDrivers = 1.12;

// `noise` of the effect: FLIP of the best techniques is little above that of the noise.
ComparisonSettings small(int side, double noise) {
    ComparisonSettings settings = comparison_settings(side, side);
    settings.grid = 3;
    settings.samples = 1800;
    settings.noise = noise;
    settings.probes = 16;
    settings.shadow_map_size = 2048;
    settings.frames = 0;
    return settings;
}

std::vector<Contestant> ratcheted_techniques() {
    std::vector<Contestant> list = default_contestants(built_in_catalog().techniques);
    const auto more = parse_technique_list(
        built_in_catalog().techniques,
        "preintegrated[diffuse=closed_form,shadow=plain],preintegrated[diffuse=curve_2015,shadow=plain]");
    EXPECT_TRUE(more) << more.error().message;
    if (more) list.insert(list.end(), more->begin(), more->end());
    return list;
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
    EXPECT_EQ(both[1].surface->all.share, 0.125);
}

TEST(Scoreboard, techniques_made_again_replace_their_own_rows_and_stay_with_their_scene) {
    const std::vector<ScoreRow> kept = {row("bust", "lambert", 0), row("bust", "wrap", 0.5),
                                        row("spheres", "lambert", 0)};
    const auto rows = merged(kept, {row("bust", "wrap", 0.25)}, MergedRows::techniques);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].scene, "spheres");
    EXPECT_EQ(rows[1].technique, "lambert");
    EXPECT_EQ(rows[2].surface->all.share, 0.25);
}

TEST(Scoreboard, every_prefix_is_read_or_refused_in_one_line) {
    const std::string text = scores_csv({row("a", "lambert", 0), row("a, \"b\"", "wrap", 0.5)});
    for (size_t length = 0; length < text.size(); ++length) {
        const auto rows = parse_scores(std::string_view(text).substr(0, length));
        if (rows) {
            EXPECT_LE(rows->size(), 2u) << length;
        } else {
            EXPECT_TRUE(rows.error().message.starts_with("scores line ")) << rows.error().message;
            EXPECT_EQ(rows.error().message.find('\n'), std::string::npos) << length;
        }
    }
}

TEST(Scoreboard, a_file_that_is_no_scoreboard_is_named_by_line) {
    const std::string good = scores_csv({row("bust", "lambert", 0.5)});
    EXPECT_THAT(parse_scores("a,b\n").error().message, HasSubstr("line 1"));
    EXPECT_THAT(parse_scores(good + "bust,wrap\n").error().message, HasSubstr("line 3: has 2 columns"));
    std::string bad = good;
    bad.replace(bad.rfind("0.5"), 3, "x");
    EXPECT_THAT(parse_scores(bad).error().message, HasSubstr("is not a number"));
    bad.replace(bad.rfind(",x,") + 1, 1, "nan");  // what could not be sorted
    EXPECT_THAT(parse_scores(bad).error().message, HasSubstr("is not finite"));
}

TEST(Scoreboard, a_file_of_before_the_modelled_cost_is_read_and_rows_without_one_have_an_empty_cell) {
    ScoreRow modelled = row("bust", "wrap", 0.5);
    modelled.model_ratio = 1.75;
    const std::string text = scores_csv({modelled});
    EXPECT_TRUE(text.ends_with(",1.75,,,,\n")) << text;
    const auto again = parse_scores(text);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_THAT(scoreboard_markdown(*again), HasSubstr("| 1.25 | 1.75 |"));

    std::string before = text;
    before.erase(before.find(",model_ratio"), std::string(",model_ratio").size());
    before.erase(before.rfind(",1.75"), 5);
    const auto rows = parse_scores(before);
    ASSERT_TRUE(rows) << rows.error().message;
    EXPECT_FALSE((*rows)[0].model_ratio);
    EXPECT_THAT(scoreboard_markdown(*rows), HasSubstr("| 1.25 |  |"));
    before.replace(before.find(",bytes"), 6, "");
    EXPECT_THAT(parse_scores(before).error().message, HasSubstr("line 1"));
}

TEST(Scoreboard, a_clip_has_columns_of_its_motion_and_other_scenes_have_none) {
    ScoreRow moving = row("bust greet", "wrap", 0.5), still = row("bust", "wrap", 0.5);
    moving.walk = moving.surface;
    moving.walk_motion.emplace().all = {.share = -0.25, .error = 0.03};
    moving.surface_motion.emplace().all = {.share = 0.75, .error = 0.04};
    const auto rows = parse_scores(scores_csv({moving, still}));
    ASSERT_TRUE(rows) << rows.error().message;
    EXPECT_EQ((*rows)[0].walk_motion->all.share, -0.25);
    EXPECT_EQ((*rows)[0].surface_motion->all.error, 0.04);
    EXPECT_FALSE((*rows)[1].walk_motion);
    const std::string text = scoreboard_markdown(*rows);
    EXPECT_THAT(text, HasSubstr("| B | its motion | of `surface` | its motion | × lambert"));
    EXPECT_THAT(text, HasSubstr(" | -0.25 ± 0.03 | 0.50 ± "));
    EXPECT_THAT(text, HasSubstr(" | 0.75 ± 0.04 | 1.25 |"));
    EXPECT_EQ(scoreboard_markdown({still}).find("motion"), std::string::npos);
}

TEST(Scoreboard, the_table_is_sorted_by_captured_share_and_the_plot_has_a_panel_a_scene) {
    const std::vector<ScoreRow> rows = {row("bust", "wrap", -0.5), row("bust", "lambert", 0),
                                        row("spheres", "wrap", 0.1)};
    const std::string text = scoreboard_markdown(rows);
    EXPECT_LT(text.find("`lambert`"), text.find("`wrap`"));
    EXPECT_EQ(scoreboard_plot(rows).panels.size(), 2u);
}

TEST(Scoreboard, a_set_of_test_scenes_is_one_table_and_no_panel) {
    const std::vector<ScoreRow> rows = {row("bust", "wrap", -0.5), row("unit/a", "wrap", 0.25),
                                        row("unit/b", "wrap", 0.125), row("unit/b", "exact", 1)};
    const std::string text = scoreboard_markdown(rows);
    EXPECT_THAT(text, HasSubstr("| b | 0 | 1.00 | 0.12 |"));
    EXPECT_THAT(text, HasSubstr("| a | 0 |  | 0.25 |"));
    EXPECT_EQ(scoreboard_plot(rows).panels.size(), 1u);
}

TEST(Scoreboard, heads_in_several_skins_are_means_and_columns) {
    std::vector<ScoreRow> rows = {row("bust", "wrap", 0.25), row("bust/dark", "wrap", 0.75),
                                  row("bust", "lambert", 0), row("bust/dark", "lambert", 0),
                                  row("ear", "wrap", 0.125)};
    for (ScoreRow& r : rows) r.walk = r.surface;
    rows[1].walk->all.share = 0.5;
    rows[0].model_ratio = 2;
    rows[1].model_ratio = 3;
    const std::string text = scoreboard_markdown(rows);
    EXPECT_THAT(text, HasSubstr("Means over 2 scenes: bust, bust/dark."));
    EXPECT_THAT(text, HasSubstr("| `wrap` | 0.38 | 0.25 | 0.00 | 0.00 | 0.00 | 0.50 | 1.25 | 2.50 | 0 |"));
    EXPECT_THAT(text, HasSubstr("| technique | bust | own profile | dark |"));
    EXPECT_THAT(text, HasSubstr("| `wrap` | 0.38 | 0.25 | 0.50 |"));
    EXPECT_THAT(text, HasSubstr("| `wrap` | 0.50 | 0.25 | 0.75 |"));
    EXPECT_THAT(text, HasSubstr("## ear"));
    EXPECT_EQ(scoreboard_plot(rows).panels.size(), 3u);

    // A file may have a technique twice in one scene and not in another.
    std::vector<ScoreRow> uneven = {row("bust", "wrap", 0.25), row("bust", "wrap", 0.5),
                                    row("bust/dark", "lambert", 0)};
    EXPECT_THAT(scoreboard_markdown(uneven), HasSubstr("| `wrap` | 0.38 | 0.38 |  |"));

    rows[1].walk->all.error = 1;
    EXPECT_THAT(scoreboard_markdown(rows), HasSubstr("| `wrap` | 0.25 (1) | 0.25 | noise |"));
}

TEST(Scoreboard, near_views_of_a_head_have_a_table_of_their_own) {
    std::vector<ScoreRow> rows = {row("bust", "wrap", 0.25), row("bust/dark", "wrap", 0.75),
                                  row("bust@nose/dark", "wrap", 0.5), row("bust@nose/pale", "wrap", 0.25)};
    for (ScoreRow& r : rows) r.walk = r.surface;
    const std::string text = scoreboard_markdown(rows);
    EXPECT_THAT(text, HasSubstr("## Heads\n\nMeans over 2 scenes: bust, bust/dark."));
    EXPECT_THAT(text, HasSubstr("## Near views\n\nMeans over 2 scenes: bust@nose/dark, bust@nose/pale."));
    EXPECT_EQ(scoreboard_plot(rows).panels.size(), 4u);
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

// Rows of these scenes against the recorded ones.
void expect_no_less_than_recorded(const std::vector<ScoreRow>& made, const std::string& driver) {
    const double flip_rise =
        driver.find("Mesa 22.") != std::string::npos ? kFlipRise : kFlipRiseOfOtherDrivers;
    const auto text = read_text_file(kRecorded);
    ASSERT_TRUE(text) << text.error().message;
    const auto recorded = parse_scores(*text);
    ASSERT_TRUE(recorded) << recorded.error().message;
    if (const char* update = std::getenv("DERMIS_UPDATE_SCORES")) {
        const bool missing_only = std::string_view(update) == "missing";
        ASSERT_TRUE(write_text_file(
            kRecorded, scores_csv(missing_only ? with_missing(*recorded, made) : merged(*recorded, made))));
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
        EXPECT_TRUE(now.surface->all.known()) << name << " +- " << now.surface->all.error;
        const double a = now.surface->all.share, b = before->surface->all.share;
        EXPECT_GE(a, b - kTolerance * std::max(1.0, 1 - b)) << name;
        EXPECT_LE(now.scores.flip, before->scores.flip * flip_rise + 2e-4) << name << ", FLIP";
    }
}

void expect_no_less_on(gpu::Device& device, const std::string& name, const Scene& scene, double noise) {
    const auto comparison =
        compare_techniques(device, built_in_catalog(), scene, ratcheted_techniques(), small(64, noise));
    ASSERT_TRUE(comparison) << comparison.error().message;
    EXPECT_EQ(comparison->rows[0].first.captured.all.share, 0) << name << ": lambert";
    expect_no_less_than_recorded(score_rows(name, *comparison), device.info().driver);
}

bool is_in_every_run(const SubjectCase& one) {
    constexpr std::string_view kNames[] = {"unit/sphere",      "unit/cylinder", "unit/relief_1mm",
                                           "unit/albedo_step", "unit/saddle",   "unit/slab_behind"};
    return std::ranges::find(kNames, one.name) != std::end(kNames);
}

// The reference has to be the exact answer where one is known, and no technique captures less than it did.
void expect_exact_answers(gpu::Device& device, bool in_every_run) {
    const auto unit = find_subject(built_in_catalog().subjects, "unit");
    ASSERT_TRUE(unit);
    auto cases = make_cases(**unit);
    ASSERT_TRUE(cases) << cases.error().message;
    std::vector<ScoreRow> made;
    size_t scenes = 0;
    for (SubjectCase& one : *cases) {
        if (is_in_every_run(one) != in_every_run) continue;
        ++scenes;
        ASSERT_TRUE(complete_scene(one.scene)) << one.name;
        // The slab returns the same everywhere, so that FLIP sees the noise alone.
        const double noise = one.name == "unit/slab_behind" ? 0.015 : in_every_run ? 0.04 : 0.03;
        ComparisonSettings settings = small(32, noise);
        settings.probes = 66;
        settings.exact = one.exact;
        const auto comparison =
            compare_techniques(device, built_in_catalog(), one.scene, ratcheted_techniques(), settings);
        ASSERT_TRUE(comparison) << one.name << ": " << comparison.error().message;
        EXPECT_EQ(comparison->rows[0].first.captured.all.share, 0) << one.name << ": lambert";
        EXPECT_LT(comparison->rows[0].first.captured.all.error, 1e-9) << one.name << ": lambert";
        size_t exact_answers = 0;
        for (ScoreRow& r : score_rows(one.name, *comparison)) {
            if (r.technique != kExactId) {
                made.push_back(std::move(r));
                continue;
            }
            ++exact_answers;
            const CapturedShare& share = r.surface->all;
            EXPECT_GT(share.share, 0.9) << one.name;
            EXPECT_GT(share.share + share.error, 0.98) << one.name << ": " << share.share;
            EXPECT_LT(share.error, 0.06) << one.name;
        }
        const bool unknown = one.name == "unit/saddle" || one.name == "unit/touching_spheres";
        EXPECT_EQ(exact_answers, unknown ? 0u : 1u) << one.name;
    }
    EXPECT_GE(scenes, 6u);
    expect_no_less_than_recorded(made, device.info().driver);
}

TEST_F(Scoreboards, no_technique_captures_less_than_it_did_of_the_spheres) {
    expect_no_less_on(device(), "spheres", load("spheres"), 0.05);
}

TEST_F(Scoreboards, no_technique_captures_less_than_it_did_of_the_bust) {
    expect_no_less_on(device(), "bust", load("bust"), 0.1);
}

TEST_F(Scoreboards, six_unit_scenes_have_their_exact_answers_and_no_technique_captures_less_than_it_did) {
    expect_exact_answers(device(), true);
}

TEST_F(Scoreboards, the_other_unit_scenes_have_theirs_and_no_technique_captures_less_than_it_did) {
    expect_exact_answers(device(), false);
}

// Of the records, which the tests above compare with what is measured now. oren_nayar is no model of
// scattering: it changes the picture by the roughness of the surface, which the reference has not.
TEST(Scoreboard, no_techniques_default_is_worse_than_lambert) {
    constexpr double kRounding = 1e-6;  // of pictures: a technique that changes nothing has shares of 1e-8
    const auto text = read_text_file(kRecorded);
    ASSERT_TRUE(text) << text.error().message;
    const auto recorded = parse_scores(*text);
    ASSERT_TRUE(recorded) << recorded.error().message;
    size_t count = 0;
    std::vector<std::string> worse;
    for (const ScoreRow& row : *recorded) {
        if (!row.settings.empty() || row.technique == "oren_nayar") continue;
        ++count;
        if (row.surface->all.share + row.surface->all.error >= -kRounding) continue;
        worse.push_back(row.technique + " " + row.scene);
    }
    EXPECT_THAT(worse, testing::IsEmpty());
    EXPECT_GE(count, 16 * (built_in_catalog().techniques.size() - 1));
}
