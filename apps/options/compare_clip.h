#pragma once
// Frames of a clip for `dermis compare`: each is a scene of its own, loaded in its pose.

#include <vector>

#include "compare_options.h"

namespace dermis::cli {

/// Times of the frames in the clip. With --fps they follow --time as those of `render`; else they are the
/// middles of equal parts of the clip from --time to its end. Loads the scene once. Errors: as
/// SceneChoice::load(), a --time past the end.
[[nodiscard]] Result<std::vector<double>> clip_times(const CompareChoice& choice);

/// The scene at a time, complete. With `first`, camera and lights are that frame's, so that the view does not
/// follow the face.
[[nodiscard]] Result<SubjectCase> clip_frame(const CompareChoice& choice, double time_s, const Scene* first);

}  // namespace dermis::cli
