#pragma once
// Frames of a clip for `dermis compare`: one scene that moves from frame to frame.

#include <memory>
#include <string>
#include <vector>

#include "compare_options.h"
#include "dermis/render/renderer.h"

namespace dermis::cli {

/// Times of the frames in the clip of the loaded scene. With --fps they follow its time as those of `render`;
/// else they are the middles of equal parts of the clip from its time to the end. Errors: a time past the
/// end.
[[nodiscard]] Result<std::vector<double>> clip_times(const CompareChoice& choice, const Scene& scene);

/// The frames of --frame-range, or all `count`.
[[nodiscard]] Result<IndexRange> clip_range(const std::string& frame_range, int count);

/// The scene in the frames of its clip. Camera and lights are those of the first frame, so that the view does
/// not follow the face.
class ClipFrames {
  public:
    /// Loads the scene in the first frame, complete. The device must outlive the result. Errors: those of
    /// clip_times(), CompareChoice::load_scene() and Renderer::create().
    [[nodiscard]] static Result<ClipFrames> load(const CompareChoice& choice, gpu::Device& device);

    [[nodiscard]] const std::vector<double>& times_s() const { return times_s_; }
    /// Moves the scene to a frame. Errors: those of move_scene().
    [[nodiscard]] Result<void> show(size_t frame);
    [[nodiscard]] const SubjectCase& shown() const { return *shown_; }
    [[nodiscard]] Renderer& renderer() { return *renderer_; }

  private:
    ClipFrames() = default;

    std::string name_;  // the names of scene and clip
    std::vector<double> times_s_;
    std::unique_ptr<SubjectCase> shown_;
    std::unique_ptr<Renderer> renderer_;  // draws shown_->scene
};

}  // namespace dermis::cli
