#include "dermis/view/shown_scene.h"

#include <algorithm>
#include <utility>

#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/scene_words.h"
#include "dermis/scene/skin_tone.h"
#include "dermis/view/scene_edit.h"
#include "dermis/view/view_line.h"

namespace dermis::view {

void ShownScene::put(Stage stage, Scene file_look, const Pose& pose, Model& model) {
    model.scene = nullptr;
    probe_.reset();
    probe_key_.clear();
    stage_.emplace(std::move(stage));
    model.scene = &stage_->scene();
    drawn_tint_ = model.scene->skin.albedo_tint_linear;
    mean_albedo_.reset();
    file_look_ = std::move(file_look);
    set_pose(pose);
}

// Forgets what is known of the surface in another pose.
void ShownScene::set_pose(const Pose& loaded) {
    loaded_pose_ = drawn_pose_ = loaded;
    on_device_alone_ = false;
    poser_.reset();
    probe_.reset();
    probe_key_.clear();
}

Result<void> ShownScene::put_objects(Scene loaded) {
    const std::vector<SceneObject>& shown = stage_->scene().objects;
    const bool fits = std::ranges::equal(shown, loaded.objects, [](const auto& a, const auto& b) {
        return a.mesh.submeshes.size() == b.mesh.submeshes.size();
    });
    if (!fits) return {};  // its files have changed and are read again
    set_pose(loaded.motion.pose());
    return stage_->replace_objects(std::move(loaded));
}

Result<void> ShownScene::follow_motion() {
    Scene& scene = stage_->scene();
    const Pose pose = scene.motion.pose();
    const auto is_stiff = [](const SceneObject& object) {
        return !object.motion.empty() && !ScenePoser::can_pose(object);
    };
    if (stage_->lacks_bakes() || pose == drawn_pose_ || std::ranges::any_of(scene.objects, is_stiff))
        return {};
    drawn_pose_ = pose;
    probe_.reset();
    probe_key_.clear();
    if (!poser_) {
        DERMIS_TRY_ASSIGN(ScenePoser poser, ScenePoser::create(scene));
        poser_.emplace(std::move(poser));
    }
    DERMIS_TRY_ASSIGN(on_device_alone_, stage_->pose_on_device(*poser_, pose));
    if (on_device_alone_) return {};
    DERMIS_TRY(poser_->pose(pose, scene));
    return stage_->vertices_moved();
}

void ShownScene::choose_tone(int tone, Model& model) {
    if (!model.scene) return;
    Skin& skin = model.scene->skin;
    if (tone == 0) {
        skin.albedo_tint_linear = stated_tint(file_look_.skin);
        skin.profile = file_look_.skin.profile;
        model.tone = 0;
        return;
    }
    const std::string name = tone_profile(tone);
    const Result<Profile> profile = find_profile(name);
    if (!profile) return model.notices.report_error("tone", profile.error().message);
    if (!tint_to(skin_tone_albedo_linear(tone), model)) return;
    skin.profile = name;
    model.tone = tone;
}

bool ShownScene::tint_to(Vec3 albedo_linear, Model& model) {
    if (!mean_albedo_) {
        const Result<Vec3> mean = mean_skin_albedo(*model.scene);
        if (!mean) return model.notices.report_error("tone", mean.error().message), false;
        mean_albedo_ = *mean;
    }
    model.scene->skin.albedo_tint_linear = tint_towards(albedo_linear, *mean_albedo_);
    return true;
}

void ShownScene::choose_pigments(const SkinModel& pigments, Model& model) {
    if (!model.scene) return;
    const Rgb albedo = skin_albedo(pigments);
    if (!tint_to({float(albedo[0]), float(albedo[1]), float(albedo[2])}, model)) return;
    Skin& skin = model.scene->skin;
    skin.profile = skin_model_text(pigments);
    // Rounded as in a saved scene, so that both draw the same.
    skin.albedo_tint_linear = saved_tint(skin) * skin.loaded_tint_linear;
    model.tone = 0;
}

void ShownScene::follow_skin() {
    const Vec3 tint = stage_->scene().skin.albedo_tint_linear;
    if (tint == drawn_tint_) return;
    drawn_tint_ = tint;
    stage_->skin_changed();
}

Result<void> ShownScene::open_panorama(const std::string& path) {
    Environment& environment = stage_->scene().environment;
    const Environment before = environment;
    environment.kind = EnvironmentKind::file;
    environment.file = path;
    Result<void> changed = stage_->environment_changed();
    if (!changed) environment = before;
    return changed;
}

Result<void> ShownScene::paste(const std::string& line, Model& model) {
    const Environment before = model.scene->environment;
    Result<void> pasted = apply_view_line(model, line);
    Environment& around = model.scene->environment;
    if (pasted && (around.kind != before.kind || around.file != before.file)) {
        pasted = stage_->environment_changed();
        if (!pasted) around = before;
    }
    if (model.scene->skin.profile != tone_profile(model.tone)) model.tone = 0;
    return pasted;
}

const std::string& ShownScene::probe(Vec2 place, PictureSize size) {
    const Scene& scene = stage_->scene();
    const std::string key = to_text(place.x) + ' ' + to_text(place.y) + ' ' + camera_text(scene.camera) +
                            std::to_string(size.width) + 'x' + std::to_string(size.height);
    if (key == probe_key_) return probe_text_;
    probe_key_ = key;
    probe_text_.clear();
    if (!probe_) {
        if (std::exchange(on_device_alone_, false) && !poser_->pose(drawn_pose_, stage_->scene()))
            return probe_text_;
        Result<Probe> probe = Probe::create(scene);
        if (!probe) return probe_text_;
        probe_.emplace(std::move(*probe));
    }
    const auto reading = probe_->at(scene.camera, place, float(size.width) / float(size.height));
    if (reading) probe_text_ = probe_text(*reading);
    return probe_text_;
}

}  // namespace dermis::view
