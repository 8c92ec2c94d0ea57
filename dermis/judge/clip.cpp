#include "dermis/judge/clip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "dermis/base/text.h"
#include "dermis/plot/plot.h"

namespace dermis::inline judge {
namespace {

constexpr std::string_view kRestSetting = "rest=";

// Settings without the last one, if that names bakes of the rest pose.
std::optional<std::string> without_rest(const std::string& settings) {
    const size_t at = settings.rfind(kRestSetting);
    if (at == std::string::npos || (at > 0 && settings[at - 1] != ',')) return std::nullopt;
    return settings.substr(0, at > 0 ? at - 1 : 0);
}

const ScoreRow* find_row(const ClipFrame& frame, const ClipRow& wanted) {
    const auto found = std::ranges::find_if(frame.rows, [&](const ScoreRow& row) {
        return row.technique == wanted.technique && row.settings == wanted.settings;
    });
    return found == frame.rows.end() ? nullptr : &*found;
}

// Of a row without bakes of the rest pose, none.
std::optional<ShareChange> change_by(Integrator integrator, const ScoreRow& row, bool rest) {
    const std::optional<ShareChange>& change =
        integrator == Integrator::walk ? row.walk_change : row.surface_change;
    return change || !rest ? change : std::optional(ShareChange{});
}

// The sums behind the captured shares of pairs of frames: |T - S|^2 and |S|^2 with the noise taken out.
void set_motion(std::span<const ClipFrame> frames, const ClipRow& row, Integrator integrator,
                ClipShare& share) {
    double left = 0, effect = 0, error_squares = 0;
    for (const ClipFrame& frame : frames) {
        const ScoreRow* found = row_of(frame, row);
        if (!found || !motion_by(integrator, *found)) continue;
        const CapturedShare& one = motion_by(integrator, *found)->all;
        if (!std::isfinite(one.share) || !std::isfinite(one.error)) continue;
        const double weight = one.effect_rms * one.effect_rms, rest = 1 - one.share;
        left += rest * rest * weight;
        effect += weight;
        error_squares += std::pow(rest * weight * one.error, 2);
    }
    if (!(effect > 0)) return;
    const double rest = std::sqrt(left / effect);
    share.motion = 1 - rest;
    share.motion_error = rest > 0 ? std::sqrt(error_squares) / (effect * rest) : 0;
}

// Of a row that every frame has.
Captured mean_captured(std::span<const ClipFrame> frames, const ClipRow& row, Integrator integrator) {
    Captured mean;
    const double weight = 1 / double(frames.size());
    const auto add = [&](CapturedShare& sum, const CapturedShare& one) {
        sum.share += weight * one.share;
        sum.error = std::hypot(sum.error, weight * one.error);
        sum.effect_rms += weight * one.effect_rms;
        sum.reference_noise += weight * one.reference_noise;
    };
    for (const ClipFrame& frame : frames) {
        const Captured& one = *captured_by(integrator, *row_of(frame, row));
        add(mean.all, one.all);
        for (size_t c = 0; c < mean.channels.size(); ++c) add(mean.channels[c], one.channels[c]);
        mean.pixels = one.pixels;
    }
    return mean;
}

std::string clip_number(double value) {
    char text[32] = "";
    if (std::isfinite(value)) std::snprintf(text, sizeof text, "%.4f", value);
    return text;
}

std::string seconds(double time_s) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f s", time_s);
    return text;
}

std::string short_share(const CapturedShare& share) {
    char text[32] = "noise";
    if (share.known()) std::snprintf(text, sizeof text, "%.2f", share.share);
    return text;
}

PlotPanel clip_panel(std::span<const ClipFrame> frames, Integrator integrator) {
    PlotPanel panel{.title = "captured share of " + std::string(judge_name(integrator)),
                    .x = {.label = "time in the clip (s)"},
                    .y = {.label = "captured share"}};
    for (const ClipRow& row : clip_rows(frames)) {
        PlotSeries series{.name = row.name(), .mark = PlotMark::line_and_points};
        for (const ClipFrame& frame : frames) {
            const ScoreRow* found = row_of(frame, row);
            if (!found || !captured_by(integrator, *found)) continue;
            series.x.push_back(frame.time_s);
            series.y.push_back(captured_by(integrator, *found)->all.share);
        }
        if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
    return panel;
}

std::string html_row(std::span<const ClipFrame> frames, const ClipRow& row, const ClipShare& share,
                     Integrator integrator) {
    std::string text = "<tr><th>" + as_markup(row.name()) + "</th><td>" + clip_number(share.mean) +
                       "</td><td>" + clip_number(share.error) + "</td><td>" + clip_number(share.worst) +
                       "</td><td>" + (share.motion ? clip_number(*share.motion) : "") + "</td><td>" +
                       (share.motion ? clip_number(share.motion_error) : "") + "</td><td>" +
                       (share.change ? clip_number(share.change->change) : "") + "</td><td>" +
                       (share.change ? clip_number(share.change->error) : "") + "</td>";
    for (const ClipFrame& frame : frames) {
        const ScoreRow* found = row_of(frame, row);
        const bool judged = found && captured_by(integrator, *found);
        text += "<td>" + (judged ? short_share(captured_by(integrator, *found)->all) : "") + "</td>";
    }
    return text + "</tr>\n";
}

std::string html_table(std::span<const ClipFrame> frames, std::span<const std::string> links,
                       Integrator integrator) {
    std::string body;
    for (const ClipRow& row : clip_rows(frames))
        if (const std::optional<ClipShare> share = clip_share(frames, row, integrator))
            body += html_row(frames, row, *share, integrator);
    if (body.empty()) return "";
    std::string head =
        "<tr><th>captured share of " + std::string(judge_name(integrator)) +
        "</th><th>mean</th><th>&plusmn;</th><th>worst</th><th>of the motion</th><th>&plusmn;</th>"
        "<th>change by bakes of rest</th>"
        "<th>&plusmn;</th>";
    for (size_t i = 0; i < frames.size(); ++i)
        head += "<th><a href=\"" + as_markup(links[i]) + "\">" + seconds(frames[i].time_s) + "</a></th>";
    return "<table>\n" + head + "</tr>\n" + body + "</table>\n";
}

}  // namespace

const std::optional<Captured>& captured_by(Integrator integrator, const ScoreRow& row) {
    return integrator == Integrator::walk ? row.walk : row.surface;
}

const std::optional<Captured>& motion_by(Integrator integrator, const ScoreRow& row) {
    return integrator == Integrator::walk ? row.walk_motion : row.surface_motion;
}

std::string ClipRow::name() const {
    return settings.empty() ? technique : technique + "[" + settings + "]";
}

std::vector<ClipRow> clip_rows(std::span<const ClipFrame> frames) {
    std::vector<ClipRow> rows;
    for (const ClipFrame& frame : frames)
        for (const ScoreRow& row : frame.rows)
            if (ClipRow named{row.technique, row.settings}; std::ranges::find(rows, named) == rows.end())
                rows.push_back(std::move(named));
    return rows;
}

const ScoreRow* row_of(const ClipFrame& frame, const ClipRow& row) {
    if (const ScoreRow* found = find_row(frame, row)) return found;
    const std::optional<std::string> remade = without_rest(row.settings);
    return remade ? find_row(frame, {row.technique, *remade}) : nullptr;
}

std::optional<ClipShare> clip_share(std::span<const ClipFrame> frames, const ClipRow& row,
                                    Integrator integrator) {
    const bool rest = without_rest(row.settings).has_value();
    ClipShare share{.worst = std::numeric_limits<double>::infinity(),
                    .worst_change = std::numeric_limits<double>::infinity()};
    ShareChange change;
    double change_squares = 0;
    for (const ClipFrame& frame : frames) {
        const ScoreRow* found = row_of(frame, row);
        if (!found || !captured_by(integrator, *found)) return std::nullopt;
        const CapturedShare& one = captured_by(integrator, *found)->all;
        if (one.known() && one.share < share.worst)
            share.worst = one.share, share.worst_time_s = frame.time_s;
        if (const auto by_rest = change_by(integrator, *found, rest)) {
            change.change += by_rest->change;
            change_squares += by_rest->error * by_rest->error;
            share.worst_change = std::min(share.worst_change, by_rest->change);
        }
    }
    const double count = double(frames.size());
    if (frames.empty()) return std::nullopt;
    const CapturedShare mean = mean_captured(frames, row, integrator).all;
    share.mean = mean.share;
    share.error = mean.error;
    if (!std::isfinite(share.worst)) share.worst = std::nan("");
    if (rest) share.change = ShareChange{change.change / count, std::sqrt(change_squares) / count};
    set_motion(frames, row, integrator, share);
    return share;
}

std::vector<ScoreRow> rows_of_clip(const std::string& name, std::span<const ClipFrame> frames) {
    std::vector<ScoreRow> rows;
    for (const ClipRow& named : clip_rows(frames)) {
        const ScoreRow* last = row_of(frames.back(), named);
        if (!last) continue;
        ScoreRow row = *last;
        row.scene = name;
        for (const Integrator integrator : kClipJudges) {
            const std::optional<ClipShare> share = clip_share(frames, named, integrator);
            if (!share) continue;
            const bool by_walk = integrator == Integrator::walk;
            (by_walk ? row.walk : row.surface) = mean_captured(frames, named, integrator);
            std::optional<Captured>& motion = by_walk ? row.walk_motion : row.surface_motion;
            motion.reset();
            if (share->motion) motion.emplace().all = {.share = *share->motion, .error = share->motion_error};
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string clip_csv(std::span<const ClipFrame> frames) {
    std::string text =
        "technique,settings,reference,frames,mean,mean_error,worst,worst_time_s,change,change_error,"
        "worst_change,motion,motion_error\n";
    for (const Integrator integrator : kClipJudges)
        for (const ClipRow& row : clip_rows(frames)) {
            const std::optional<ClipShare> share = clip_share(frames, row, integrator);
            if (!share) continue;
            const std::optional<ShareChange>& change = share->change;
            text += row.technique + ",\"" + row.settings + "\"," + std::string(judge_name(integrator)) + "," +
                    std::to_string(frames.size()) + "," + clip_number(share->mean) + "," +
                    clip_number(share->error) + "," + clip_number(share->worst) + "," +
                    clip_number(share->worst_time_s) + "," + (change ? clip_number(change->change) : "") +
                    "," + (change ? clip_number(change->error) : "") + "," +
                    (change ? clip_number(share->worst_change) : "") + "," +
                    (share->motion ? clip_number(*share->motion) : "") + "," +
                    (share->motion ? clip_number(share->motion_error) : "") + "\n";
        }
    return text;
}

std::string clip_html(const std::string& title, const std::string& credit, std::span<const ClipFrame> frames,
                      std::span<const std::string> links) {
    Plot plot{.panels = {}, .columns = 1, .panel_width_px = 900};
    std::string tables;
    for (const Integrator integrator : kClipJudges) {
        const std::string table = html_table(frames, links, integrator);
        if (table.empty()) continue;
        plot.panels.push_back(clip_panel(frames, integrator));
        tables += table;
    }
    return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>" + as_markup(title) +
           "</title>\n<style>\nbody { font: 15px/1.5 system-ui, sans-serif; margin: 24px; }\n"
           "table { border-collapse: collapse; margin: 20px 0; font-variant-numeric: tabular-nums; }\n"
           "th, td { padding: 4px 8px; border-bottom: 1px solid #ccc; text-align: right; }\n"
           "th:first-child { text-align: left; }\n</style></head>\n<body>\n<h1>" +
           as_markup(title) +
           "</h1>\n<p>Of each technique, how much of what scattering does it has: 1 is all, 0 none. Of the "
           "motion: "
           "the share of what scattering changes from frame to frame; below 0 it flickers. "
           "A time links to the report of that frame.</p>\n" +
           plot_svg(plot) + tables + (credit.empty() ? "" : "<p>" + as_markup(credit) + "</p>\n") +
           "</body></html>\n";
}

}  // namespace dermis::inline judge
