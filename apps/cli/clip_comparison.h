#pragma once
// `dermis compare --clip NAME --frames N`: a comparison for each frame, and the shares over all of them.

#include <string>
#include <vector>

#include "compare_clip.h"

namespace dermis::cli {

/// A folder frame_NN with report.html for each frame; report.html (shares over time), clip.csv, scores.csv
/// and regions.csv for all. A frame is compared when it is loaded, so memory holds one. After Ctrl-C what is
/// there are the frames so far; the references stay in the cache. A `range` of the frames alone writes their
/// folders and leaves what is of all frames to a later run, which finds its references in the cache. Returns
/// the exit status.
[[nodiscard]] Result<int> run_clip_comparison(const CompareChoice& choice, IndexRange range,
                                              const std::string& output, bool json);

/// The reports of a range of frames.
[[nodiscard]] std::vector<std::string> clip_reports(const std::string& output, IndexRange range);

}  // namespace dermis::cli
