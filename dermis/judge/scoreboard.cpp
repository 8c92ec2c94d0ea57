#include "dermis/judge/scoreboard.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dermis/base/text.h"

namespace dermis {
namespace {

// Beyond the defaults of every technique.
constexpr std::string_view kSettings =
    "preintegrated[shadow=plain],"
    "preintegrated[diffuse=closed_form,shadow=plain],"
    "preintegrated[diffuse=curve_2015,ambient=curve_2015],"
    "preintegrated[diffuse=curve_2015,ambient=curve_2015,shadow=plain],"
    "preintegrated[construction=ring,shadow=plain],"
    "preintegrated[normals=sharp,shadow=plain],"
    "texture_space[light_map_size=2048],"
    "texture_space[space=mm],"
    "texture_space[filter=gaussian],"
    "texture_space[specular_shadow=off]";

constexpr std::string_view kHeading =
    "scene,technique,settings,rmse,rel_mse,psnr_db,ssim,delta_e_2000,flip,terminator_rmse,penumbra_rmse,time_"
    "ms,"
    "bytes,time_ratio,reference_rmse";

std::string figures(double value, const char* format = "%.4g") {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

// Fields of one line; quotes as RFC 4180 has them.
std::vector<std::string> csv_fields(std::string_view line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

Result<ScoreboardRow> parse_row(std::string_view line, size_t number) {
    const std::vector<std::string> fields = csv_fields(line);
    const std::vector<std::string_view> names = split(kHeading, ',');
    const auto wrong = [&](const std::string& what) {
        return Error{"scoreboard line " + std::to_string(number) + ": " + what};
    };
    if (fields.size() != names.size())
        return wrong("has " + std::to_string(fields.size()) + " columns, not " +
                     std::to_string(names.size()));
    std::vector<std::optional<double>> values;
    for (size_t i = 3; i < fields.size(); ++i) {
        const std::optional<double> value = parse_number(fields[i]);
        const bool optional = names[i] == "terminator_rmse" || names[i] == "penumbra_rmse";
        if (!value && !(optional && fields[i].empty()))
            return wrong("'" + fields[i] + "' under " + std::string(names[i]) + " is no number");
        // Rows are sorted and plotted by these. Equal pictures have an infinite PSNR.
        const bool sound = !value || std::isfinite(*value) || (names[i] == "psnr_db" && *value > 0);
        if (!sound) return wrong("'" + fields[i] + "' under " + std::string(names[i]) + " is not finite");
        values.push_back(value);
    }
    ScoreboardRow row{.row = {.scene = fields[0], .technique = fields[1], .settings = fields[2]},
                      .time_ratio = *values[10],
                      .reference_rmse = *values[11]};
    row.row.scores = {.rmse = *values[0],
                      .rel_mse = *values[1],
                      .psnr_db = *values[2],
                      .ssim = *values[3],
                      .delta_e_2000 = *values[4],
                      .flip = *values[5],
                      .terminator_rmse = values[6],
                      .penumbra_rmse = values[7]};
    row.row.time_ms = *values[8];
    constexpr double kMostBytes = 1e15;
    row.row.bytes = size_t(std::clamp(*values[9], 0.0, kMostBytes));
    return row;
}

std::vector<std::string> scenes_of(const std::vector<ScoreboardRow>& rows) {
    std::vector<std::string> scenes;
    for (const ScoreboardRow& row : rows)
        if (std::ranges::find(scenes, row.row.scene) == scenes.end()) scenes.push_back(row.row.scene);
    return scenes;
}

std::vector<ScoreboardRow> rows_of(const std::vector<ScoreboardRow>& rows, const std::string& scene) {
    std::vector<ScoreboardRow> own;
    std::ranges::copy_if(rows, std::back_inserter(own),
                         [&](const ScoreboardRow& row) { return row.row.scene == scene; });
    std::ranges::stable_sort(own, {}, [](const ScoreboardRow& row) { return row.row.scores.rmse; });
    return own;
}

std::string memory_text(size_t bytes) {
    if (bytes == 0) return "0";
    return bytes >= 1u << 20 ? figures(double(bytes) / (1 << 20), "%.1f MiB")
                             : figures(double(bytes) / 1024, "%.0f KiB");
}

std::string markdown_row(const ScoreboardRow& row) {
    const Scores& s = row.row.scores;
    const auto part = [](const std::optional<double>& v) {
        return v ? figures(*v, "%.4f") : std::string("-");
    };
    std::string settings = row.row.settings.empty() ? "" : " " + row.row.settings;
    for (size_t at = 0; (at = settings.find(',', at)) != std::string::npos; at += 2)
        settings.insert(at + 1, " ");
    return "| `" + row.row.technique + "`" + settings + " | " + figures(s.rmse, "%.4f") + " | " +
           part(s.terminator_rmse) + " | " + part(s.penumbra_rmse) + " | " + figures(s.flip, "%.4f") + " | " +
           figures(s.delta_e_2000, "%.2f") + " | " + figures(s.ssim, "%.4f") + " | " +
           figures(row.time_ratio, "%.2f") + " | " + memory_text(row.row.bytes) + " |\n";
}

}  // namespace

std::vector<Contestant> scoreboard_contestants() {
    std::vector<Contestant> list = default_contestants();
    const Result<std::vector<Contestant>> more = parse_technique_list(kSettings);
    assert(more && "kSettings names what a technique does not have");
    if (more) list.insert(list.end(), more->begin(), more->end());
    return list;
}

std::vector<ScoreboardRow> scoreboard_rows(const std::string& scene, const Comparison& comparison) {
    std::vector<ScoreboardRow> rows;
    const std::vector<ScoreRow> scores = score_rows(scene, comparison);
    for (size_t i = 0; i < scores.size(); ++i)
        rows.push_back({scores[i], comparison.rows[i].time_ratio, comparison.reference_rmse});
    return rows;
}

std::string scoreboard_csv(const std::vector<ScoreboardRow>& rows) {
    std::string text(kHeading);
    text += '\n';
    for (const ScoreboardRow& row : rows) {
        const std::string table = scores_csv({row.row});
        const size_t begin = table.find('\n') + 1;
        text += table.substr(begin, table.size() - begin - 1) + "," + figures(row.time_ratio) + "," +
                figures(row.reference_rmse) + "\n";
    }
    return text;
}

Result<std::vector<ScoreboardRow>> parse_scoreboard(std::string_view text) {
    std::vector<ScoreboardRow> rows;
    size_t number = 0;
    for (const std::string_view line : split(text, '\n')) {
        ++number;
        if (number == 1 && trim(line) != kHeading)
            return Error{"scoreboard line 1: the heading is not " + std::string(kHeading)};
        if (number == 1 || trim(line).empty()) continue;
        Result<ScoreboardRow> row = parse_row(trim(line), number);
        if (!row) return row.error();
        rows.push_back(std::move(*row));
    }
    return rows;
}

std::vector<ScoreboardRow> merged(std::vector<ScoreboardRow> kept, const std::vector<ScoreboardRow>& made) {
    const std::vector<std::string> scenes = scenes_of(made);
    std::erase_if(kept, [&](const ScoreboardRow& row) {
        return std::ranges::find(scenes, row.row.scene) != scenes.end();
    });
    kept.insert(kept.end(), made.begin(), made.end());
    return kept;
}

std::string scoreboard_markdown(const std::vector<ScoreboardRow>& rows) {
    std::string text;
    for (const std::string& scene : scenes_of(rows)) {
        const std::vector<ScoreboardRow> own = rows_of(rows, scene);
        text +=
            "## " + scene + "\n\nNoise of the ground truth: RMSE " +
            figures(own.front().reference_rmse, "%.2g") +
            ".\n\n| technique | RMSE | terminator | penumbra | FLIP | ΔE 2000 | SSIM | × lambert | memory |\n"
            "|---|---|---|---|---|---|---|---|---|\n";
        for (const ScoreboardRow& row : own) text += markdown_row(row);
        text += "\n";
    }
    return text;
}

Plot scoreboard_plot(const std::vector<ScoreboardRow>& rows) {
    Plot plot{.title = "Error against cost",
              .caption = "RMSE of linear radiance over the skin; frame time over lambert's"};
    for (const std::string& scene : scenes_of(rows)) {
        PlotPanel panel{.title = scene,
                        .x = {.label = "frame time over lambert's", .scale = PlotScale::logarithmic},
                        .y = {.label = "RMSE", .scale = PlotScale::logarithmic}};
        for (const ScoreboardRow& row : rows_of(rows, scene)) {
            auto series = std::ranges::find(panel.series, row.row.technique, &PlotSeries::name);
            if (series == panel.series.end()) {
                panel.series.push_back({.name = row.row.technique, .mark = PlotMark::points, .width_px = 3});
                series = std::prev(panel.series.end());
            }
            series->x.push_back(row.time_ratio);
            series->y.push_back(row.row.scores.rmse);
        }
        std::ranges::sort(panel.series, {}, &PlotSeries::name);
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

}  // namespace dermis
