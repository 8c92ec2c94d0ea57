// One panel at a time: ranges from the data, ticks from the ranges, then grid, curves, frame and text are
// appended to one string, back to front.

#include "dermis/plot/plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/base/vec.h"

namespace dermis::inline plot {
namespace {

struct PlotTick {
    double value;
    std::string label;  // markup; empty: a thin grid line only
};

// A resolved axis: position() maps [min, max] to [0, 1].
struct PlotAxisScale {
    PlotScale kind;
    double min, max;

    bool shows(double value) const {
        return std::isfinite(value) && (kind == PlotScale::linear || value > 0);
    }
    double position(double value) const {
        if (kind == PlotScale::linear) return (value - min) / (max - min);
        return std::log(value / min) / std::log(max / min);
    }
};

constexpr double kMaxAutomaticDecades = 8;

// The step of 1, 2 or 5 times a power of ten that gives about `count` ticks.
double nice_step(double range, double count) {
    const double rough = range / count;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double lead = rough / power;
    return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

std::string linear_label(double value, double step) {
    // Rounded to the step's own digits: 0.30000000000000004 is 0.3.
    const double digits = std::pow(10.0, std::max(0.0, 1 - std::floor(std::log10(step))));
    const double rounded = digits < 1e12 ? std::round(value * digits) / digits : value;
    return to_text(rounded == 0 ? 0.0 : rounded);
}

std::string power_label(int mantissa, int exponent) {
    if (exponent >= -3 && exponent <= 4) return to_text(mantissa * std::pow(10.0, exponent));
    const std::string lead = mantissa == 1 ? "" : std::to_string(mantissa) + "·";
    return fmt::format("{}10<tspan dy=\"-4\" font-size=\"9\">{}</tspan>", lead, exponent);
}

std::vector<PlotTick> logarithmic_ticks(const PlotAxisScale& scale) {
    std::vector<PlotTick> ticks;
    const double decades = std::log10(scale.max / scale.min);
    const int first = int(std::floor(std::log10(scale.min) - 1e-9));
    const int last = int(std::ceil(std::log10(scale.max) + 1e-9));
    const int stride = std::max(1, int(std::ceil(decades / 8)));
    for (int exponent = first; exponent <= last; ++exponent)
        for (int mantissa = 1; mantissa <= 9; ++mantissa) {
            const double value = mantissa * std::pow(10.0, exponent);
            if (value < scale.min * (1 - 1e-9) || value > scale.max * (1 + 1e-9)) continue;
            const bool labelled = mantissa == 1 ? (exponent - first) % stride == 0
                                                : decades < 2 && (mantissa == 2 || mantissa == 5);
            if (labelled)
                ticks.push_back({value, power_label(mantissa, exponent)});
            else if (decades < 5)
                ticks.push_back({value, ""});
        }
    return ticks;
}

// Rounding y outwards keeps curves inside the frame; x keeps the exact range of the data.
void round_outwards(PlotAxisScale& scale, const PlotAxis& axis) {
    if (scale.kind == PlotScale::logarithmic) {
        if (!axis.max) scale.max = std::pow(10.0, std::ceil(std::log10(scale.max) - 1e-9));
        if (!axis.min) scale.min = std::pow(10.0, std::floor(std::log10(scale.min) + 1e-9));
        if (!axis.min) scale.min = std::max(scale.min, scale.max * std::pow(10.0, -kMaxAutomaticDecades));
        return;
    }
    const double step = nice_step(scale.max - scale.min, 5);
    if (!axis.max) scale.max = step * std::ceil(scale.max / step - 1e-9);
    if (!axis.min) scale.min = step * std::floor(scale.min / step + 1e-9);
}

std::vector<PlotTick> axis_ticks(const PlotAxisScale& scale, double length_px) {
    if (scale.kind == PlotScale::logarithmic) return logarithmic_ticks(scale);
    std::vector<PlotTick> ticks;
    const double step = nice_step(scale.max - scale.min, std::max(2.0, length_px / 55));
    const double first = std::ceil(scale.min / step - 1e-9), last = std::floor(scale.max / step + 1e-9);
    for (double i = first; i <= last; ++i) ticks.push_back({i * step, linear_label(i * step, step)});
    return ticks;
}

// Range of x or of y (`values`) over all series of the panel. `rounded`: outwards to a tick.
PlotAxisScale resolve_axis(const PlotPanel& panel, const PlotAxis& axis,
                           std::vector<double> PlotSeries::*values, bool rounded) {
    PlotAxisScale scale{axis.scale, std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
    for (const PlotSeries& series : panel.series)
        for (const double value : series.*values)
            if (scale.shows(value)) {
                scale.min = std::min(scale.min, value);
                scale.max = std::max(scale.max, value);
            }
    const bool logarithmic = axis.scale == PlotScale::logarithmic;
    if (!(scale.min <= scale.max)) scale.min = logarithmic ? 0.1 : 0, scale.max = 1;  // nothing to show
    if (axis.min && scale.shows(*axis.min)) scale.min = *axis.min;
    if (axis.max && scale.shows(*axis.max)) scale.max = *axis.max;
    if (!(scale.min < scale.max)) {  // one value: widen the range
        if (logarithmic)
            scale.max = scale.min * 10;
        else
            scale.max = scale.min + std::max(1e-6, std::abs(scale.min) * 0.1);
    }
    if (rounded) round_outwards(scale, axis);
    return scale;
}

// Dark enough for thin lines on white, alternating in lightness so that neighbours differ in a grey print.
constexpr std::array<std::string_view, 10> kPalette = {"#1864ab", "#e8590c", "#2b8a3e", "#9c36b5", "#c92a2a",
                                                       "#0b8fa3", "#7a5c00", "#495057", "#e64980", "#5c940d"};
constexpr double kMarginLeft = 66, kMarginRight = 18, kMarginBottom = 46, kLegendLine = 18;

struct Rect {
    double x, y, width, height;
};

// Two decimals, a hundredth of a pixel, are exact enough and halve the file.
std::string px(double value) {
    std::string text = to_text(std::round(std::clamp(value, -1e5, 1e5) * 100) / 100);
    return text == "-0" ? "0" : text;
}

// Sans-serif fonts differ; 0.56 em per glyph is at least the mean width in all common ones.
double estimated_width_px(std::string_view text, double size_px) {
    const auto is_start = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };  // UTF-8
    return 0.56 * size_px * double(std::ranges::count_if(text, is_start));
}

std::string text_element(double x, double y, std::string_view attributes, std::string_view content) {
    return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" " + std::string(attributes) + ">" +
           std::string(content) + "</text>\n";
}

std::string line_element(double x1, double y1, double x2, double y2, std::string_view attributes) {
    return "<line x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) + "\" " +
           std::string(attributes) + "/>\n";
}

std::string stroke_attributes(const PlotSeries& series, std::string_view color) {
    std::string text = "fill=\"none\" stroke=\"" + as_markup(color) + "\" stroke-width=\"" +
                       px(series.width_px) + "\" stroke-linejoin=\"round\"";
    if (series.stroke == PlotStroke::dashed) text += " stroke-dasharray=\"7 4\"";
    if (series.stroke == PlotStroke::dotted) text += " stroke-dasharray=\"1.5 3.5\" stroke-linecap=\"round\"";
    return text;
}

std::string circle(double x, double y, std::string_view color) {
    return "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"2.6\" fill=\"" + as_markup(color) +
           "\"/>\n";
}

std::string_view color_of(const PlotPanel& panel, size_t index) {
    if (!panel.series[index].color.empty()) return panel.series[index].color;
    const auto without_color = [](const PlotSeries& series) { return series.color.empty(); };
    const auto before =
        std::count_if(panel.series.begin(), panel.series.begin() + long(index), without_color);
    return kPalette[size_t(before) % kPalette.size()];
}

// Leaves out points close to the straight line between the last kept point and the next: else the straight
// parts of finely sampled curves would be most of the file.
std::string path_data(const std::vector<Vec2>& points) {
    constexpr float kTolerance_px = 0.03f;
    std::string path;
    Vec2 kept;
    for (size_t i = 0; i < points.size(); ++i) {
        if (i > 0 && i + 1 < points.size()) {
            const Vec2 chord = points[i + 1] - kept;
            if (std::abs(cross(chord, points[i] - kept)) < kTolerance_px * length(chord)) continue;
        }
        path += (i == 0 ? "M" : "L") + px(points[i].x) + " " + px(points[i].y);
        kept = points[i];
    }
    return path;
}

std::string draw_series(const PlotSeries& series, std::string_view color, const PlotAxisScale& x_scale,
                        const PlotAxisScale& y_scale, const Rect& area) {
    assert(series.x.size() == series.y.size());
    std::string path, marks;
    std::vector<Vec2> unbroken;
    const auto lift_pen = [&] { path += path_data(unbroken), unbroken.clear(); };
    for (size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
        if (!x_scale.shows(series.x[i]) || !y_scale.shows(series.y[i])) {
            lift_pen();
            continue;
        }
        const double x = area.x + area.width * x_scale.position(series.x[i]);
        const double y = area.y + area.height * (1 - y_scale.position(series.y[i]));
        unbroken.push_back({float(std::clamp(x, -1e5, 1e5)), float(std::clamp(y, -1e5, 1e5))});
        if (series.mark != PlotMark::line) marks += circle(x, y, color);
    }
    lift_pen();
    std::string out;
    if (series.mark != PlotMark::points && !path.empty())
        out += "<path " + stroke_attributes(series, color) + " d=\"" + path + "\"/>\n";
    return out + marks;
}

std::string draw_grid(const Rect& area, const PlotAxisScale& x_scale, const PlotAxisScale& y_scale) {
    std::string lines, words;
    const auto shade = [](const PlotTick& tick) {
        return tick.label.empty() ? "stroke=\"#f1f3f5\"" : "stroke=\"#dee2e6\"";
    };
    for (const PlotTick& tick : axis_ticks(x_scale, area.width)) {
        const double x = area.x + area.width * x_scale.position(tick.value);
        lines += line_element(x, area.y, x, area.y + area.height, shade(tick));
        if (!tick.label.empty())
            words += text_element(x, area.y + area.height + 16, "text-anchor=\"middle\"", tick.label);
    }
    for (const PlotTick& tick : axis_ticks(y_scale, area.height)) {
        const double y = area.y + area.height * (1 - y_scale.position(tick.value));
        lines += line_element(area.x, y, area.x + area.width, y, shade(tick));
        if (!tick.label.empty()) words += text_element(area.x - 7, y + 4, "text-anchor=\"end\"", tick.label);
    }
    return lines + "<g font-size=\"11\" fill=\"#495057\">\n" + words + "</g>\n";
}

struct LegendEntry {
    size_t series;
    double x;
    int line;
};

// Entries flow left to right and wrap at the panel's edge.
std::vector<LegendEntry> lay_out_legend(const PlotPanel& panel, double width_px) {
    std::vector<LegendEntry> entries;
    double x = 0;
    int line = 0;
    for (size_t i = 0; i < panel.series.size(); ++i) {
        if (panel.series[i].name.empty()) continue;
        const double entry_width = 30 + estimated_width_px(panel.series[i].name, 12) + 14;
        if (x > 0 && x + entry_width > width_px) x = 0, ++line;
        entries.push_back({i, x, line});
        x += entry_width;
    }
    return entries;
}

std::string draw_legend(const PlotPanel& panel, const std::vector<LegendEntry>& entries, double x, double y) {
    std::string out;
    for (const LegendEntry& entry : entries) {
        const PlotSeries& series = panel.series[entry.series];
        const std::string_view color = color_of(panel, entry.series);
        const double x0 = x + entry.x, y0 = y + kLegendLine * entry.line;
        if (series.mark != PlotMark::points)
            out += line_element(x0, y0, x0 + 24, y0, stroke_attributes(series, color));
        if (series.mark != PlotMark::line) out += circle(x0 + 12, y0, color);
        out += text_element(x0 + 30, y0 + 4, "font-size=\"12\"", as_markup(series.name));
    }
    return out;
}

std::string draw_panel(const PlotPanel& panel, const Rect& cell, const std::string& clip_id) {
    std::string out;
    double top = cell.y + 8;
    if (!panel.title.empty()) {
        out += text_element(cell.x + kMarginLeft, top + 12, "font-size=\"13\" font-weight=\"600\"",
                            as_markup(panel.title));
        top += 22;
    }
    const auto entries = lay_out_legend(panel, cell.width - kMarginLeft - kMarginRight);
    out += draw_legend(panel, entries, cell.x + kMarginLeft, top + 6);
    if (!entries.empty()) top += kLegendLine * (entries.back().line + 1) + 4;

    const Rect area{cell.x + kMarginLeft, top, cell.width - kMarginLeft - kMarginRight,
                    std::max(40.0, cell.y + cell.height - kMarginBottom - top)};
    const PlotAxisScale x_scale = resolve_axis(panel, panel.x, &PlotSeries::x, false);
    const PlotAxisScale y_scale = resolve_axis(panel, panel.y, &PlotSeries::y, true);
    out += draw_grid(area, x_scale, y_scale);

    const std::string box = " x=\"" + px(area.x) + "\" y=\"" + px(area.y) + "\" width=\"" + px(area.width) +
                            "\" height=\"" + px(area.height) + "\"";
    out += "<clipPath id=\"" + clip_id + "\"><rect" + box + "/></clipPath>\n<g clip-path=\"url(#" + clip_id +
           ")\">\n";
    for (size_t i = 0; i < panel.series.size(); ++i)
        out += draw_series(panel.series[i], color_of(panel, i), x_scale, y_scale, area);
    out += "</g>\n<rect" + box + " fill=\"none\" stroke=\"#868e96\"/>\n";

    const double x_middle = area.x + area.width / 2, y_middle = area.y + area.height / 2;
    out += text_element(x_middle, area.y + area.height + 36, "font-size=\"12\" text-anchor=\"middle\"",
                        as_markup(panel.x.label));
    const double label_x = cell.x + 16;
    out += text_element(label_x, y_middle,
                        "font-size=\"12\" text-anchor=\"middle\" transform=\"rotate(-90 " + px(label_x) +
                            " " + px(y_middle) + ")\"",
                        as_markup(panel.y.label));
    return out;
}

}  // namespace

std::string plot_svg(const Plot& plot) {
    const size_t columns = std::clamp<size_t>(plot.panels.size(), 1, size_t(std::max(1, plot.columns)));
    const size_t rows = std::max<size_t>(1, (plot.panels.size() + columns - 1) / columns);
    const double title_height = plot.title.empty() ? 0 : 32, caption_height = plot.caption.empty() ? 0 : 24;
    const double width = plot.panel_width_px * double(columns);
    const double height = title_height + plot.panel_height_px * double(rows) + caption_height;

    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + px(width) + "\" height=\"" +
                      px(height) + "\" viewBox=\"0 0 " + px(width) + " " + px(height) +
                      "\" font-family=\"system-ui, 'DejaVu Sans', 'Liberation Sans', Arial, sans-serif\" "
                      "fill=\"#212529\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    if (!plot.title.empty())
        out += text_element(16, 23, "font-size=\"16\" font-weight=\"600\"", as_markup(plot.title));
    for (size_t i = 0; i < plot.panels.size(); ++i) {
        const Rect cell{plot.panel_width_px * double(i % columns),
                        title_height + plot.panel_height_px * double(i / columns), plot.panel_width_px,
                        plot.panel_height_px};
        out += draw_panel(plot.panels[i], cell, "panel" + std::to_string(i));
    }
    if (!plot.caption.empty())
        out += text_element(16, height - 10, "font-size=\"11\" fill=\"#495057\"", as_markup(plot.caption));
    return out + "</svg>\n";
}

Result<void> write_plot(const std::filesystem::path& path, const Plot& plot) {
    if (to_lower(path.extension().string()) != ".svg")
        return Error{path.string() + ": plots are written as .svg, not '" + path.extension().string() + "'"};
    return write_text_file(path, plot_svg(plot));
}

}  // namespace dermis::inline plot
