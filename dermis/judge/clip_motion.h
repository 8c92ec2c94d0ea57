#pragma once
// The share of the motion: how much of what scattering changes from one frame of a clip to the next a
// technique changes too.
//
// It is the captured share (captured.h) of the differences T' - T and S' - S at each pixel that is skin in
// both frames. 1: the technique moves as the reference does. 0: as `lambert` does. Below 0: its error changes
// more between the frames than the effect itself, which is seen as flicker or swimming. References have one
// seed, so that most of their noise cancels where the surface stays.

#include <array>
#include <optional>
#include <vector>

#include "dermis/judge/clip.h"

namespace dermis::inline judge {

/// Effects of one frame, kept for the next one. Arrays are in the order of kClipJudges, empty where that
/// reference did not judge.
struct ClipEffects {
    struct Row {
        ClipRow row;
        std::array<Image, 2> effects;
    };
    std::array<std::optional<EffectHalves>, 2> references;
    Image skin;
    std::vector<Row> rows;
};

[[nodiscard]] ClipEffects clip_effects(const Comparison& comparison);

/// Sets walk_motion and surface_motion of `rows`, those of the frame of `now`. A row that the frame before
/// lacks has none.
[[nodiscard]] Result<void> set_motion_shares(const ClipEffects& before, const ClipEffects& now,
                                             std::vector<ScoreRow>& rows);

/// The frames of a clip that are compared so far.
struct ComparedFrames {
    std::vector<ClipFrame> all;
    std::optional<ClipEffects> last;  ///< effects of the frame that was added last

    /// Frames are added in their order; `name` is the scene of the frame's rows. Errors: those of
    /// set_motion_shares().
    [[nodiscard]] Result<void> add(const std::string& name, double time_s, const Comparison& comparison);
};

}  // namespace dermis::inline judge
