#include "dermis/judge/scoreboard.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "dermis/judge/scoreboard_heads.h"

namespace dermis::inline judge {
namespace {

// Beyond the defaults of every technique.
constexpr std::string_view kSettings =
    "preintegrated[gain=none],"
    "texture_space_gaussians[gain=none],"
    "preintegrated[gain=map],"
    "texture_space_gaussians[gain=map],"
    "preintegrated[gain=links],"
    "texture_space_gaussians[gain=links],"
    "texture_space_gaussians[gain=links,light_map_size=288],"
    "preintegrated[diffuse=walk],"
    "preintegrated[shadow=scattered],"
    "preintegrated[shadow=plain],"
    "preintegrated[normals=blended],"
    "preintegrated[diffuse=closed_form,shadow=plain],"
    "preintegrated[diffuse=curve_2015,ambient=curve_2015],"
    "preintegrated[diffuse=half_ring,shadow=plain],"
    "preintegrated[normals=sharp,shadow=plain],"
    "texture_space[preset=source],"
    "wrap[width=source],"
    "screen_space_separable[follow=none]";

std::string figures(double value, const char* format = "%.4g") {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

bool better(const ScoreRow& a, const ScoreRow& b) {
    const CapturedShare &x = headline(a).all, &y = headline(b).all;
    if (x.known() != y.known()) return x.known();
    return x.known() && x.share != y.share ? x.share > y.share : a.scores.rmse < b.scores.rmse;
}

std::vector<ScoreRow> rows_of(const std::vector<ScoreRow>& rows, const std::string& scene) {
    std::vector<ScoreRow> own;
    std::ranges::copy_if(rows, std::back_inserter(own),
                         [&](const ScoreRow& row) { return row.scene == scene; });
    std::ranges::stable_sort(own, better);
    return own;
}

// "unit" of "unit/sphere" when it is one of a set of test scenes, which have exact answers among them.
std::string set_of(const std::vector<ScoreRow>& rows, const std::string& scene) {
    const size_t slash = scene.find('/');
    if (slash == std::string::npos) return "";
    const std::string set = scene.substr(0, slash);
    const bool exact = std::ranges::any_of(rows, [&](const ScoreRow& row) {
        return row.technique == kExactId && row.scene.starts_with(set + "/");
    });
    return exact ? set : "";
}

std::string share_and_error_text(const CapturedShare& share) {
    return share_text(share) + (share.known() ? " ± " + figures(share.error, "%.2f") : "");
}

std::string ratio_text(std::optional<double> ratio) {
    return ratio ? figures(*ratio, "%.2f") : "";
}

std::string motion_text(const std::optional<Captured>& motion) {
    return motion ? share_and_error_text(motion->all) : "";
}

std::string markdown_row(const ScoreRow& row, bool moves) {
    const Captured& captured = headline(row);
    std::string text =
        "| " + technique_cell(row.technique, row.settings) + " | " + share_and_error_text(captured.all);
    for (const CapturedShare& channel : captured.channels) text += " | " + share_text(channel);
    if (moves) text += " | " + motion_text(row.walk ? row.walk_motion : row.surface_motion);
    if (row.walk && row.surface) {
        text += " | " + share_and_error_text(row.surface->all);
        if (moves) text += " | " + motion_text(row.surface_motion);
    }
    return text + " | " + figures(row.time_ratio, "%.2f") + " | " + ratio_text(row.model_ratio) + " | " +
           memory_text(row.bytes) + " |\n";
}

std::string effect_text(const std::optional<Captured>& captured, const std::string& judge) {
    if (!captured) return "";
    return "By `" + judge + "`, scattering changes the picture by " +
           figures(captured->all.effect_rms, "%.2g") +
           " (RMS); noise of the reference: " + figures(captured->all.reference_noise, "%.2g") + ".";
}

std::string effects_text(const ScoreRow& row) {
    const std::string walk = effect_text(row.walk, "walk"), surface = effect_text(row.surface, "surface");
    return walk + (walk.empty() || surface.empty() ? "" : "\n") + surface;
}

using Share = std::optional<Captured> ScoreRow::*;

// A row a scene and a column a technique with its defaults, the exact answer first. Empty: no row has this
// share.
std::string set_table(const std::vector<ScoreRow>& rows, const std::string& set, Share which,
                      const std::string& judge) {
    if (std::ranges::none_of(rows, [&](const ScoreRow& row) {
            return row.scene.starts_with(set + "/") && (row.*which).has_value();
        }))
        return "";
    std::vector<std::string> techniques = {std::string(kExactId)}, scenes;
    for (const ScoreRow& row : rows) {
        if (!row.scene.starts_with(set + "/") || !row.settings.empty()) continue;
        if (std::ranges::find(techniques, row.technique) == techniques.end())
            techniques.push_back(row.technique);
        if (std::ranges::find(scenes, row.scene) == scenes.end()) scenes.push_back(row.scene);
    }
    std::string text = "Captured share of `" + judge + "`.\n\n| scene | effect ", rule = "|---|---";
    for (const std::string& technique : techniques) {
        text += "| `" + technique + "` ";
        rule += "|---";
    }
    text += "|\n" + rule + "|\n";
    for (const std::string& scene : scenes) {
        const std::vector<ScoreRow> own = rows_of(rows, scene);
        text += "| " + scene.substr(set.size() + 1) + " | " +
                (own.front().*which ? figures((own.front().*which)->all.effect_rms, "%.2g") : "");
        for (const std::string& technique : techniques) {
            const auto row = std::ranges::find_if(
                own, [&](const ScoreRow& r) { return r.technique == technique && r.settings.empty(); });
            text += " | " + (row == own.end() || !((*row).*which) ? "" : share_text(((*row).*which)->all));
        }
        text += " |\n";
    }
    return text + "\n";
}

std::string set_markdown(const std::vector<ScoreRow>& rows, const std::string& set) {
    return "## " + set + "\n\n`" + std::string(kExactId) +
           "` is the share of the profile's exact answer. Intervals are in scoreboard.csv.\n\n" +
           set_table(rows, set, &ScoreRow::walk, "walk") +
           set_table(rows, set, &ScoreRow::surface, "surface");
}

// Rows of scenes that have several skins.
std::vector<ScoreRow> rows_of_heads(const std::vector<ScoreRow>& rows) {
    std::vector<ScoreRow> heads;
    std::ranges::copy_if(rows, std::back_inserter(heads), [&](const ScoreRow& row) {
        const std::string start = head_of(row.scene) + "/";
        return set_of(rows, start).empty() && std::ranges::any_of(rows, [&](const ScoreRow& other) {
                   return other.scene.starts_with(start);
               });
    });
    return heads;
}

// The other rows.
std::vector<ScoreRow> rows_without(std::vector<ScoreRow> rows, const std::vector<ScoreRow>& heads) {
    const std::vector<std::string> scenes = scenes_of(heads);
    std::erase_if(rows,
                  [&](const ScoreRow& row) { return std::ranges::find(scenes, row.scene) != scenes.end(); });
    return rows;
}

std::string scene_markdown(const std::string& scene, const std::vector<ScoreRow>& own) {
    const bool both = own.front().walk && own.front().surface;
    const bool moves = std::ranges::any_of(own, [](const ScoreRow& row) {
        return row.walk_motion.has_value() || row.surface_motion.has_value();
    });
    const std::string motion = moves ? " its motion |" : "", rule = moves ? "---|" : "";
    std::string text = "## " + scene + "\n\n" + effects_text(own.front()) + "\n\n| technique | of `" +
                       std::string(own.front().walk ? "walk" : "surface") + "` | R | G | B |" + motion +
                       (both ? " of `surface` |" + motion : "") +
                       " × lambert measured | modelled | memory |\n" + "|---|---|---|---|---|---|---|---|" +
                       rule + (both ? "---|" + rule : "") + "\n";
    for (const ScoreRow& row : own) text += markdown_row(row, moves);
    return text + "\n";
}

PlotPanel scene_panel(const std::string& scene, const std::vector<ScoreRow>& own) {
    const bool modelled =
        std::ranges::all_of(own, [](const ScoreRow& row) { return row.model_ratio.has_value(); });
    PlotPanel panel = share_panel(scene, modelled);
    for (const ScoreRow& row : own)
        if (const CapturedShare& all = headline(row).all; all.known())
            add_share(panel, row.technique, modelled ? *row.model_ratio : row.time_ratio, all.share);
    return panel;
}

}  // namespace

std::vector<Contestant> scoreboard_contestants(std::span<const Technique> techniques) {
    std::vector<Contestant> list = default_contestants(techniques);
    const Result<std::vector<Contestant>> more = parse_technique_list(techniques, kSettings);
    assert(more && "kSettings names what a technique does not have");
    if (more) list.insert(list.end(), more->begin(), more->end());
    return list;
}

std::vector<ScoreRow> merged(std::vector<ScoreRow> kept, const std::vector<ScoreRow>& made,
                             MergedRows replaced) {
    const std::vector<std::string> scenes = scenes_of(made);
    const auto made_again = [&](const ScoreRow& row) {
        return replaced == MergedRows::scenes || std::ranges::any_of(made, [&](const ScoreRow& r) {
                   return r.scene == row.scene && r.technique == row.technique && r.settings == row.settings;
               });
    };
    std::vector<ScoreRow> rows, of_scenes;
    for (ScoreRow& row : kept)
        if (std::ranges::find(scenes, row.scene) == scenes.end())
            rows.push_back(std::move(row));
        else if (!made_again(row))
            of_scenes.push_back(std::move(row));
    for (const std::string& scene : scenes) {
        std::ranges::copy_if(of_scenes, std::back_inserter(rows),
                             [&](const ScoreRow& r) { return r.scene == scene; });
        std::ranges::copy_if(made, std::back_inserter(rows),
                             [&](const ScoreRow& r) { return r.scene == scene; });
    }
    return rows;
}

std::string scoreboard_markdown(const std::vector<ScoreRow>& all) {
    const std::vector<ScoreRow> heads = rows_of_heads(all), rows = rows_without(all, heads);
    const HeadsAndViews both = apart(heads);
    std::string text = heads_markdown(both.heads, "Heads") + heads_markdown(both.views, "Near views");
    std::vector<std::string> sets;
    for (const std::string& scene : scenes_of(rows)) {
        const std::string set = set_of(rows, scene);
        if (set.empty())
            text += scene_markdown(scene, rows_of(rows, scene));
        else if (std::ranges::find(sets, set) == sets.end()) {
            text += set_markdown(rows, set);
            sets.push_back(set);
        }
    }
    return text;
}

Plot scoreboard_plot(const std::vector<ScoreRow>& all) {
    const std::vector<ScoreRow> heads = rows_of_heads(all), rows = rows_without(all, heads);
    const HeadsAndViews both = apart(heads);
    Plot plot{
        .title = "Captured share over cost",
        .caption = "1: all that scattering does to the picture, 0: none of it; below -0.5 drawn at -0.5",
        .panels = heads_panels(both.heads, "heads")};
    std::ranges::move(heads_panels(both.views, "near views"), std::back_inserter(plot.panels));
    for (const std::string& scene : scenes_of(rows))
        if (set_of(rows, scene).empty()) plot.panels.push_back(scene_panel(scene, rows_of(rows, scene)));
    return plot;
}

}  // namespace dermis::inline judge
