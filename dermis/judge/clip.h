#pragma once
// A technique over the frames of a clip: mean and worst of its captured shares.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dermis/judge/comparison.h"

namespace dermis::inline judge {

/// What is kept of a frame's comparison.
struct ClipFrame {
    double time_s = 0;  ///< in the clip
    std::vector<ScoreRow> rows;
};

/// One row of all frames by one reference.
struct ClipShare {
    double mean = 0;
    double error = 0;  ///< half of the mean's 95 % interval by the reference's noise
    double worst = 0;  ///< the lowest share of a frame that is known; NaN where none is
    double worst_time_s = 0;
    /// Of a row with bakes of the rest pose: from the row with bakes of each pose, the mean and the frame
    /// that loses most.
    std::optional<ShareChange> change = {};
    double worst_change = 0;  ///< the least; read it only with `change`
    /// Share of the motion over all pairs of frames together (clip_motion.h), and half of its 95 % interval.
    std::optional<double> motion = {};
    double motion_error = 0;
};
/// Technique and settings of a row.
struct ClipRow {
    std::string technique, settings;

    /// "wrap[wrap=0.4]", or the id alone.
    [[nodiscard]] std::string name() const;
    friend bool operator==(const ClipRow&, const ClipRow&) = default;
};
/// References of a clip's tables, in their order.
inline constexpr Integrator kClipJudges[] = {Integrator::walk, Integrator::surface};
/// Missing where the row was not judged by that reference.
[[nodiscard]] const std::optional<Captured>& captured_by(Integrator integrator, const ScoreRow& row);
[[nodiscard]] const std::optional<Captured>& motion_by(Integrator integrator, const ScoreRow& row);

/// Those of all frames, in the order of their first frame.
[[nodiscard]] std::vector<ClipRow> clip_rows(std::span<const ClipFrame> frames);

/// The row of a frame. A row with bakes of the rest pose that changed no pixel of this frame is the row
/// without them; null where the frame has neither.
[[nodiscard]] const ScoreRow* row_of(const ClipFrame& frame, const ClipRow& row);

/// Missing where a frame was not judged by that reference.
[[nodiscard]] std::optional<ClipShare> clip_share(std::span<const ClipFrame> frames, const ClipRow& row,
                                                  Integrator integrator);

/// A row for each technique, as of one scene with that name: means of the captured shares and
/// of their effects, the share of the motion, and of the last frame its costs, memory and errors.
[[nodiscard]] std::vector<ScoreRow> rows_of_clip(const std::string& name, std::span<const ClipFrame> frames);

/// technique,settings,reference,frames,mean,mean_error,worst,worst_time_s,change,change_error,worst_change,
/// motion,motion_error: a line for each row and reference. `change` is empty for rows with all bakes of the
/// pose, `motion` where no pair of frames has any that is more than noise.
[[nodiscard]] std::string clip_csv(std::span<const ClipFrame> frames);

/// A page with a plot of the shares over time, their table, and a link to each frame's report
/// (`links`, relative).
[[nodiscard]] std::string clip_html(const std::string& title, const std::string& credit,
                                    std::span<const ClipFrame> frames, std::span<const std::string> links);

}  // namespace dermis::inline judge
