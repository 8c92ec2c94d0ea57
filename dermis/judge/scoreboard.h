#pragma once
// All techniques on all scenes in one table that is kept: docs/scoreboard.csv, .md and .svg.

#include <string>
#include <vector>

#include "dermis/judge/comparison.h"
#include "dermis/plot/plot.h"

namespace dermis::inline judge {

/// Every technique with its defaults, and the settings whose difference is worth knowing; the baseline first.
[[nodiscard]] std::vector<Contestant> scoreboard_contestants(std::span<const Technique> techniques);

enum class MergedRows { scenes, techniques };

/// Rows of scenes that `made` holds are replaced, all others stay; or only rows of the same scene, technique
/// and settings.
[[nodiscard]] std::vector<ScoreRow> merged(std::vector<ScoreRow> kept, const std::vector<ScoreRow>& made,
                                           MergedRows replaced = MergedRows::scenes);

/// Heads in several skins (scoreboard_heads.h), then a table a scene, sorted by captured share; rows whose
/// share is not known come last, by error. A set of test scenes ("unit/sphere", "unit/strip" ...) is one
/// table.
[[nodiscard]] std::string scoreboard_markdown(const std::vector<ScoreRow>& rows);

/// Captured share over modelled cost, or over measured cost where the model was not computed: two panels for
/// the heads, one for each scene that is not of a set.
[[nodiscard]] Plot scoreboard_plot(const std::vector<ScoreRow>& rows);

}  // namespace dermis::inline judge
