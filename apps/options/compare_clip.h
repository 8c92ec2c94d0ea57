#pragma once
// Frames of a clip for `dermis compare`: each is a scene of its own, loaded in its pose.

#include <optional>
#include <vector>

#include "compare_options.h"
#include "dermis/judge/clip_motion.h"

namespace dermis::cli {

/// Times of the frames in the clip. With --fps they follow --time as those of `render`; else they are the
/// middles of equal parts of the clip from --time to its end. Loads the scene once. Errors: as
/// SceneChoice::load(), a --time past the end.
[[nodiscard]] Result<std::vector<double>> clip_times(const CompareChoice& choice);

/// The frames of --frame-range, or all `count`.
[[nodiscard]] Result<IndexRange> clip_range(const std::string& frame_range, int count);

/// Camera and lights at a time, for clip_frame().
[[nodiscard]] Result<Scene> clip_view(const CompareChoice& choice, double time_s);

/// The scene at a time, complete. With `first`, camera and lights are that frame's, so that the view does not
/// follow the face.
[[nodiscard]] Result<SubjectCase> clip_frame(const CompareChoice& choice, double time_s, const Scene* first);

/// The frames of a clip that are compared so far.
struct ComparedFrames {
    std::vector<ClipFrame> all;
    std::optional<ClipEffects> last;  ///< effects of the frame that was added last

    /// Frames are added in their order. Errors: those of set_motion_shares().
    [[nodiscard]] Result<void> add(const SubjectCase& one, double time_s, const Comparison& comparison);
};

}  // namespace dermis::cli
