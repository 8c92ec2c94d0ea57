#pragma once
// Line plots as SVG, for `--plot`, the score tables and the documentation: panels side by side, linear or
// logarithmic axes, a legend above each panel, text as text, colours that are legible on white and distinct
// by lightness as well as hue.
//
//     Plot plot{.title = "Burley", .panels = {{.x = {.label = "r (mm)"}, .y = {.label = "R (1/mm^2)"}}}};
//     plot.panels[0].series.push_back({.name = "red", .x = r_mm, .y = reflectance, .color = kPlotRed});
//     Result<void> written = write_plot("burley.svg", plot);
//
// A file of 3 curves with 200 points each is about 12 KB.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline plot {

inline constexpr std::string_view kPlotRed = "#c92a2a";
inline constexpr std::string_view kPlotGreen = "#2b8a3e";
inline constexpr std::string_view kPlotBlue = "#1864ab";
/// The colours of the three channels, in order.
inline constexpr std::string_view kPlotChannel[3] = {kPlotRed, kPlotGreen, kPlotBlue};

enum class PlotScale { linear, logarithmic };
enum class PlotStroke { solid, dashed, dotted };
enum class PlotMark { line, points, line_and_points };

/// A missing end is chosen from the data: exact on x, rounded outwards to a tick on y, at most eight decades
/// on a logarithmic y axis.
struct PlotAxis {
    std::string label;
    PlotScale scale = PlotScale::linear;
    std::optional<double> min = std::nullopt, max = std::nullopt;
};

/// x and y have the same length. A value that is not finite, or not positive on a logarithmic axis, breaks
/// the line; what lies outside the axes is clipped.
struct PlotSeries {
    std::string name;  ///< empty: not in the legend
    std::vector<double> x, y;
    std::string color = {};  ///< as CSS writes it; empty: the next of the built-in palette
    PlotStroke stroke = PlotStroke::solid;
    PlotMark mark = PlotMark::line;
    double width_px = 1.8;
};

struct PlotPanel {
    std::string title = {};
    PlotAxis x, y;
    std::vector<PlotSeries> series = {};
};

struct Plot {
    std::string title = {};
    std::string caption = {};  ///< one line below everything: source, settings
    std::vector<PlotPanel> panels = {};
    int columns = 2;  ///< panels in a row, at most
    double panel_width_px = 460, panel_height_px = 320;
};

/// The whole SVG document. Same plot, same bytes.
[[nodiscard]] std::string plot_svg(const Plot& plot);

/// Errors: an extension other than .svg, a file that cannot be written.
[[nodiscard]] Result<void> write_plot(const std::filesystem::path& path, const Plot& plot);

}  // namespace dermis::inline plot
