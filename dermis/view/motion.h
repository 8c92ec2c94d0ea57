#pragma once
// Motion of the shown scene: clips, time and morph targets.

#include <string>
#include <vector>

#include "dermis/view/shown_scene.h"

namespace dermis::view {

/// Whether the scene's meshes have clips or morph targets.
[[nodiscard]] bool has_motion(const Scene& scene);
/// Those of all objects, each name once.
[[nodiscard]] std::vector<ClipInfo> clips_of(const Scene& scene);
[[nodiscard]] std::vector<std::string> targets_of(const Scene& scene);

/// The scene's motion is this one. Errors: those of check_motion().
[[nodiscard]] Result<void> set_motion(Scene& scene, MotionDescription motion);

/// Time begins to go on: of the scene's clip, else of the first. A clip that is over begins again. Errors: a
/// scene without clips.
[[nodiscard]] Result<void> play(Model& model);
/// A clip without `loop` stops at its end.
void advance_motion(Model& model, double elapsed_s);

/// Words that load the scene with its motion of now; `file`: what the scene's files say.
[[nodiscard]] std::vector<SceneWord> words_to_load(const Model& model, const Scene& file);

/// The lines of a script's print.
[[nodiscard]] std::string motion_text(const Model& model);

/// A pose that rests is loaded, so that curvature, occlusion and baked maps are those of the pose.
class RestingPose {
  public:
    /// The scene was not loaded in its pose, which rests and was not asked for yet.
    [[nodiscard]] bool is_to_be_loaded(const Model& model, const ShownScene& shown, double now_s);
    /// The loading of this pose has begun. Once: what fails is not tried again before the pose changes.
    void asked(const ShownScene& shown) { asked_ = shown.stage().scene().motion.pose(); }
    /// It will be loaded, as soon as nothing moves.
    [[nodiscard]] bool is_due(const ShownScene& shown) const {
        return !shown.is_loaded_in_its_pose() && asked_ != shown.stage().scene().motion.pose();
    }

  private:
    Pose seen_;
    std::optional<Pose> asked_;
    double changed_s_ = 0;
};

}  // namespace dermis::view
