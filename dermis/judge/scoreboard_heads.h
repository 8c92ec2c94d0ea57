#pragma once
// Heads of the scoreboard: scenes that are judged in several skins ("bust", "bust/openpbr_skin_1" ...), as
// means over all of them and, for each reference, over each head and each skin.

#include <span>
#include <string>
#include <vector>

#include "dermis/judge/scores.h"
#include "dermis/plot/plot.h"

namespace dermis::inline judge {

/// Over the scenes where the reference is fine enough: `count` of the `judged` ones; `lowest` is their worst.
struct MeanShare {
    double mean = 0, lowest = 0;
    int count = 0, judged = 0;
};

/// A technique with its settings over all heads and skins. Costs are means of the ratios to the baseline.
struct HeadRow {
    std::string technique, settings;
    MeanShare walk, surface;
    std::array<MeanShare, 3> walk_channels;
    double time_ratio = 0;
    std::optional<double> model_ratio;
    size_t bytes = 0;  ///< the largest
};

/// Names in the order of their first rows.
[[nodiscard]] std::vector<std::string> scenes_of(std::span<const ScoreRow> rows);

/// The part of a scene's name before the slash.
[[nodiscard]] std::string head_of(const std::string& scene);

/// `rows` of heads alone; a row for each technique that is in all scenes of them, best `walk` first.
[[nodiscard]] std::vector<HeadRow> head_rows(std::span<const ScoreRow> rows);

/// Rows of heads, and of near views of them ("head_scan@nose/openpbr_skin_1").
struct HeadsAndViews {
    std::vector<ScoreRow> heads, views;
};
[[nodiscard]] HeadsAndViews apart(const std::vector<ScoreRow>& rows);

/// Means over all scenes, then over each head and each skin. Empty without rows.
[[nodiscard]] std::string heads_markdown(std::span<const ScoreRow> rows, std::string_view title);

/// Mean share of each reference over the mean cost; `name` is what their titles start with.
[[nodiscard]] std::vector<PlotPanel> heads_panels(std::span<const ScoreRow> rows, const std::string& name);

/// A panel without series, and a point of a technique added to it; a share below kLowestPlotted is drawn
/// there.
[[nodiscard]] PlotPanel share_panel(const std::string& title, bool modelled);
void add_share(PlotPanel& panel, const std::string& technique, double cost, double share);

inline constexpr double kLowestPlotted = -0.5;

/// "preintegrated" shadow=plain, gain=none, as a table has it.
[[nodiscard]] std::string technique_cell(const std::string& technique, std::string settings);
[[nodiscard]] std::string memory_text(size_t bytes);
/// "noise" where it is not known.
[[nodiscard]] std::string share_text(const CapturedShare& share);

}  // namespace dermis::inline judge
