#include "dermis/judge/scoreboard_heads.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace dermis::inline judge {
namespace {

void add(MeanShare& mean, const CapturedShare& share) {
    ++mean.judged;
    if (!share.known() || !std::isfinite(share.share)) return;
    mean.lowest = mean.count == 0 ? share.share : std::min(mean.lowest, share.share);
    mean.mean += (share.share - mean.mean) / ++mean.count;
}

// Skins of a head beside each other.
std::vector<std::string> sorted_scenes_of(std::span<const ScoreRow> rows) {
    std::vector<std::string> scenes = scenes_of(rows);
    std::ranges::sort(scenes);
    return scenes;
}

HeadRow mean_of(const std::vector<const ScoreRow*>& rows) {
    HeadRow mean{.technique = rows.front()->technique, .settings = rows.front()->settings};
    const double weight = 1.0 / double(rows.size());
    mean.model_ratio = 0;
    for (const ScoreRow* row : rows) {
        if (row->walk) {
            add(mean.walk, row->walk->all);
            for (size_t c = 0; c < 3; ++c) add(mean.walk_channels[c], row->walk->channels[c]);
        }
        if (row->surface) add(mean.surface, row->surface->all);
        mean.time_ratio += row->time_ratio * weight;
        if (mean.model_ratio && row->model_ratio)
            *mean.model_ratio += *row->model_ratio * weight;
        else
            mean.model_ratio.reset();
        mean.bytes = std::max(mean.bytes, row->bytes);
    }
    return mean;
}

// A mean of fewer scenes than all says of how many.
std::string mean_text(const MeanShare& share, size_t all) {
    if (share.count == 0) return share.judged > 0 ? "noise" : "";
    const std::string text = fmt::format("{:.2f}", share.mean);
    return size_t(share.count) == all ? text : fmt::format("{} ({})", text, share.count);
}

std::string means_table(const std::vector<HeadRow>& means, size_t scenes) {
    std::string text =
        "| technique | of `walk` | lowest | R | G | B | of `surface` | × lambert measured | modelled | "
        "memory |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n";
    for (const HeadRow& row : means) {
        text += fmt::format("| {} | {} | {} |", technique_cell(row.technique, row.settings),
                            mean_text(row.walk, scenes),
                            row.walk.count == 0 ? "" : fmt::format("{:.2f}", row.walk.lowest));
        for (const MeanShare& channel : row.walk_channels) text += " " + mean_text(channel, scenes) + " |";
        text += fmt::format(" {} | {:.2f} | {} | {} |\n", mean_text(row.surface, scenes), row.time_ratio,
                            row.model_ratio ? fmt::format("{:.2f}", *row.model_ratio) : "",
                            memory_text(row.bytes));
    }
    return text + "\n";
}

using Share = std::optional<Captured> ScoreRow::*;

// "openpbr_skin_1" of "bust/openpbr_skin_1".
std::string skin_of(const std::string& scene) {
    const size_t slash = scene.find('/');
    return slash == std::string::npos ? "own profile" : scene.substr(slash + 1);
}

// Heads, then skins, without repetition.
std::vector<std::string> groups_of(const std::vector<std::string>& scenes) {
    std::vector<std::string> groups;
    for (std::string (*name_of)(const std::string&) : {head_of, skin_of})
        for (const std::string& scene : scenes)
            if (const std::string name = name_of(scene); std::ranges::find(groups, name) == groups.end())
                groups.push_back(name);
    return groups;
}

std::string by_group_table(std::span<const ScoreRow> rows, const std::vector<HeadRow>& means, Share which,
                           std::string_view judge) {
    if (std::ranges::none_of(rows, [&](const ScoreRow& row) { return (row.*which).has_value(); })) return "";
    const std::vector<std::string> groups = groups_of(sorted_scenes_of(rows));
    std::string text = fmt::format(
                    "Captured share of `{}`: means of each head and of each skin.\n\n| technique |", judge),
                rule = "|---|";
    for (const std::string& group : groups) {
        text += " " + group + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const HeadRow& mean : means) {
        text += "| " + technique_cell(mean.technique, mean.settings) + " |";
        for (const std::string& group : groups) {
            MeanShare share;
            for (const ScoreRow& row : rows)
                if (row.technique == mean.technique && row.settings == mean.settings && (row.*which) &&
                    (head_of(row.scene) == group || skin_of(row.scene) == group))
                    add(share, (row.*which)->all);
            text += " " + mean_text(share, size_t(share.judged)) + " |";
        }
        text += "\n";
    }
    return text + "\n";
}

}  // namespace

std::vector<std::string> scenes_of(std::span<const ScoreRow> rows) {
    std::vector<std::string> scenes;
    for (const ScoreRow& row : rows)
        if (std::ranges::find(scenes, row.scene) == scenes.end()) scenes.push_back(row.scene);
    return scenes;
}

std::string head_of(const std::string& scene) {
    return scene.substr(0, scene.find('/'));
}

std::vector<HeadRow> head_rows(std::span<const ScoreRow> rows) {
    const size_t scenes = scenes_of(rows).size();
    std::vector<std::vector<const ScoreRow*>> groups;
    for (const ScoreRow& row : rows) {
        const auto group = std::ranges::find_if(groups, [&](const std::vector<const ScoreRow*>& g) {
            return g[0]->technique == row.technique && g[0]->settings == row.settings;
        });
        if (group == groups.end())
            groups.push_back({&row});
        else
            group->push_back(&row);
    }
    std::vector<HeadRow> means;
    for (const auto& group : groups)
        if (group.size() == scenes) means.push_back(mean_of(group));
    std::ranges::stable_sort(means, [](const HeadRow& a, const HeadRow& b) {
        return a.walk.count != b.walk.count ? a.walk.count > b.walk.count : a.walk.mean > b.walk.mean;
    });
    return means;
}

HeadsAndViews apart(const std::vector<ScoreRow>& rows) {
    HeadsAndViews both;
    for (const ScoreRow& row : rows)
        (row.scene.find('@') == std::string::npos ? both.heads : both.views).push_back(row);
    return both;
}

std::string heads_markdown(std::span<const ScoreRow> rows, std::string_view title) {
    if (rows.empty()) return "";
    const std::vector<std::string> scenes = sorted_scenes_of(rows);
    const std::vector<HeadRow> means = head_rows(rows);
    return fmt::format(
               "## {}\n\nMeans over {} scenes: {}. A number in brackets: of how many scenes, where the "
               "reference of the others is too\nnoisy for it.\n\n",
               title, scenes.size(), fmt::join(scenes, ", ")) +
           means_table(means, scenes.size()) + by_group_table(rows, means, &ScoreRow::walk, "walk") +
           by_group_table(rows, means, &ScoreRow::surface, "surface");
}

std::vector<PlotPanel> heads_panels(std::span<const ScoreRow> rows, const std::string& name) {
    const std::vector<HeadRow> means = head_rows(rows);
    const bool modelled =
        std::ranges::all_of(means, [](const HeadRow& row) { return row.model_ratio.has_value(); });
    std::vector<PlotPanel> panels;
    for (const auto& [of, share] :
         {std::pair(", share of walk", &HeadRow::walk), {", share of surface", &HeadRow::surface}}) {
        PlotPanel panel = share_panel(name + of, modelled);
        for (const HeadRow& row : means)
            if ((row.*share).count > 0)
                add_share(panel, row.technique, modelled ? *row.model_ratio : row.time_ratio,
                          (row.*share).mean);
        if (!panel.series.empty()) panels.push_back(std::move(panel));
    }
    return panels;
}

PlotPanel share_panel(const std::string& title, bool modelled) {
    return {.title = title,
            .x = {.label = modelled ? "modelled frame time over lambert's" : "frame time over lambert's",
                  .scale = PlotScale::logarithmic},
            .y = {.label = "captured share", .min = kLowestPlotted, .max = 1.0}};
}

void add_share(PlotPanel& panel, const std::string& technique, double cost, double share) {
    auto series = std::ranges::find(panel.series, technique, &PlotSeries::name);
    if (series == panel.series.end()) {
        panel.series.push_back({.name = technique, .mark = PlotMark::points, .width_px = 3});
        std::ranges::sort(panel.series, {}, &PlotSeries::name);
        series = std::ranges::find(panel.series, technique, &PlotSeries::name);
    }
    series->x.push_back(cost);
    series->y.push_back(std::max(share, kLowestPlotted));
}

std::string technique_cell(const std::string& technique, std::string settings) {
    for (size_t at = 0; (at = settings.find(',', at)) != std::string::npos; at += 2)
        settings.insert(at + 1, " ");
    return "`" + technique + "`" + (settings.empty() ? "" : " " + settings);
}

std::string memory_text(size_t bytes) {
    if (bytes == 0) return "0";
    return bytes >= 1u << 20 ? fmt::format("{:.1f} MiB", double(bytes) / (1 << 20))
                             : fmt::format("{:.0f} KiB", double(bytes) / 1024);
}

std::string share_text(const CapturedShare& share) {
    return share.known() ? fmt::format("{:.2f}", share.share) : "noise";
}

}  // namespace dermis::inline judge
