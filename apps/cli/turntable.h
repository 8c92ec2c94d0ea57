#pragma once
// A turn of the camera as numbered pictures or a film: what render --turn and view --turntable share.

#include <string>

#include "dermis/render/output.h"
#include "render_options.h"

namespace dermis::cli {

/// "out/%04d.png" with the number in its place; a name without %d comes back as it is.
[[nodiscard]] std::string frame_path(const std::string& pattern, int frame);

/// Those names of a range of frames; one where the name has no number.
[[nodiscard]] std::vector<std::filesystem::path> frame_files(const std::string& pattern, IndexRange range);

struct Turntable {
    RenderOptions render;
    std::string output = "out/%04d.png";  ///< a pattern, or a film: .mp4 (30 frames a second, needs ffmpeg)
    int frames = 240;
};

/// The pictures, or the film and its first frame. Errors: an output that is neither.
[[nodiscard]] Result<FileUse> turntable_files(const Turntable& turntable);

/// A whole turn. Errors: no ffmpeg, what ffmpeg says.
[[nodiscard]] Result<int> run_turntable(const Turntable& turntable);

}  // namespace dermis::cli
