#pragma once
// All techniques on all scenes in one table that is kept: docs/scoreboard.csv, .md and .svg.

#include <string>
#include <string_view>
#include <vector>

#include "dermis/judge/comparison.h"
#include "dermis/plot/plot.h"

namespace dermis {

/// Every technique with its defaults, and the settings whose difference is worth knowing; lambert first.
[[nodiscard]] std::vector<Contestant> scoreboard_contestants();

struct ScoreboardRow {
    ScoreRow row;
    double time_ratio = 0;      ///< frame time over lambert's in the same rounds
    double reference_rmse = 0;  ///< noise of the ground truth it was held against
};

[[nodiscard]] std::vector<ScoreboardRow> scoreboard_rows(const std::string& scene,
                                                         const Comparison& comparison);

/// The columns of scores_csv() and time_ratio,reference_rmse.
[[nodiscard]] std::string scoreboard_csv(const std::vector<ScoreboardRow>& rows);

/// The inverse. Errors name line and column: another heading, too few columns, no number.
[[nodiscard]] Result<std::vector<ScoreboardRow>> parse_scoreboard(std::string_view text);

/// Rows of scenes that `made` holds are replaced, all others stay.
[[nodiscard]] std::vector<ScoreboardRow> merged(std::vector<ScoreboardRow> kept,
                                                const std::vector<ScoreboardRow>& made);

/// A table a scene, sorted by error.
[[nodiscard]] std::string scoreboard_markdown(const std::vector<ScoreboardRow>& rows);

/// Error against cost, a panel a scene.
[[nodiscard]] Plot scoreboard_plot(const std::vector<ScoreboardRow>& rows);

}  // namespace dermis
