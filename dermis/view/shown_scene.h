#pragma once
// The scene in the window: its pictures, what its files said of it, its skin tone, and what is under the
// mouse.

#include <optional>
#include <string>

#include "dermis/optics/tissue/skin_model.h"
#include "dermis/scene/pose_scene.h"
#include "dermis/view/probe.h"
#include "dermis/view/stage.h"

namespace dermis::view {

class ShownScene {
  public:
    [[nodiscard]] bool is_there() const { return stage_.has_value(); }
    [[nodiscard]] Stage& stage() { return *stage_; }
    [[nodiscard]] const Stage& stage() const { return *stage_; }
    /// As the scene's files have it; without objects.
    [[nodiscard]] const Scene& file_look() const { return file_look_; }

    /// Takes the place of what was shown; model.scene is the new one. `pose`: that its objects were loaded
    /// in.
    void put(Stage stage, Scene file_look, const Pose& pose, Model& model);

    /// The vertices follow the scene's motion; curvature turns with them, and what is made of the shape
    /// (occlusion, baked maps, gains) stays as it was loaded. Nothing happens for meshes that only loading
    /// can pose (ScenePoser::can_pose), and before the scene has its bakes.
    [[nodiscard]] Result<void> follow_motion();
    /// The same scene, loaded in another pose or with its bakes.
    [[nodiscard]] Result<void> put_objects(Scene loaded);
    [[nodiscard]] const Pose& loaded_pose() const { return loaded_pose_; }
    /// Whether the scene was loaded in the pose that its motion has now.
    [[nodiscard]] bool is_loaded_in_its_pose() const {
        return !is_there() || loaded_pose_ == stage_->scene().motion.pose();
    }

    /// 0: as the maps are, with the profile that the scene came with; 1 to 6: OpenPBR's skins. Says what is
    /// wrong as a notice.
    void choose_tone(int tone, Model& model);
    /// The profile and, by a tint, the mean colour of a skin of these pigments. Model::tone becomes 0.
    void choose_pigments(const SkinModel& pigments, Model& model);
    /// The materials on the device follow the tint; the profile is asked for at every drawing.
    void follow_skin();
    /// A panorama takes the environment's place. After an error nothing has changed.
    [[nodiscard]] Result<void> open_panorama(const std::string& path);
    /// Applies a line of the command line (view_line.h).
    [[nodiscard]] Result<void> paste(const std::string& line, Model& model);

    /// The surface at a place of the picture, 0..1; measured again when place, size or camera change.
    [[nodiscard]] const std::string& probe(Vec2 place, PictureSize size);

  private:
    void set_pose(const Pose& loaded);
    /// A tint that gives the skin this mean colour; false, with a notice, where there is no skin.
    bool tint_to(Vec3 albedo_linear, Model& model);

    std::optional<Stage> stage_;
    std::optional<Probe> probe_;
    Scene file_look_;
    std::optional<Vec3> mean_albedo_;
    Vec3 drawn_tint_;  ///< what the materials on the device were made with
    std::string probe_text_, probe_key_;
    Pose loaded_pose_, drawn_pose_;
    bool on_device_alone_ = false;     ///< the scene's vertices are not in drawn_pose_ yet
    std::optional<ScenePoser> poser_;  ///< of the objects in loaded_pose_; made when they move
};

}  // namespace dermis::view
