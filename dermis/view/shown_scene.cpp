#include "dermis/view/shown_scene.h"

#include "dermis/base/text.h"
#include "dermis/image/colour.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/scene_words.h"
#include "dermis/scene/skin_tone.h"
#include "dermis/view/view_line.h"

namespace dermis::view {

void ShownScene::put(Stage stage, Scene file_look, Model& model) {
    model.scene = nullptr;
    probe_.reset();
    probe_key_.clear();
    stage_.emplace(std::move(stage));
    model.scene = &stage_->scene();
    drawn_tint_ = model.scene->skin.albedo_tint_linear;
    mean_albedo_.reset();
    file_look_ = std::move(file_look);
}

void ShownScene::choose_tone(int tone, Model& model) {
    if (!model.scene) return;
    Skin& skin = model.scene->skin;
    if (tone == 0) {
        skin.albedo_tint_linear = file_look_.skin.albedo_tint_linear;
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
    model.scene->skin.profile = skin_model_text(pigments);
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
        Result<Probe> probe = Probe::create(scene);
        if (!probe) return probe_text_;
        probe_.emplace(std::move(*probe));
    }
    const auto reading = probe_->at(scene.camera, place, float(size.width) / float(size.height));
    if (reading) probe_text_ = probe_text(*reading);
    return probe_text_;
}

}  // namespace dermis::view
