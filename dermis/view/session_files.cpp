// What a person brings and takes away: dropped files, skin tones, views as text, saved scenes; the probe.

#include <algorithm>
#include <cmath>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/image/skin_colour.h"
#include "dermis/optics/presets.h"
#include "dermis/render/skin_tone.h"
#include "dermis/scene/scene_words.h"
#include "dermis/view/scene_edit.h"
#include "dermis/view/session.h"
#include "dermis/view/view_line.h"

namespace dermis::view {
namespace fs = std::filesystem;

void Session::open_file(const std::string& path) {
    const std::string extension = to_lower(fs::path(path).extension().string());
    if (extension == ".hdr") return open_panorama(path);
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") return open_truth(path);
    if (extension != ".exr") return load(path);
    // Twice as wide as high is a panorama; anything else is a rendered picture.
    const Result<LoadedImage> loaded = read_image(path, ImageUse::color);
    if (!loaded) return model_.notices.complain("open", loaded.error().message);
    if (loaded->image.width == 2 * loaded->image.height) return open_panorama(path);
    open_truth(path);
}

void Session::open_panorama(const std::string& path) {
    if (!model_.scene) return;
    const Environment before = model_.scene->environment;
    model_.scene->environment.kind = EnvironmentKind::file;
    model_.scene->environment.file = path;
    const Result<void> changed = stage_->environment_changed();
    if (changed) {
        scene_files_.add({path});
        return model_.notices.inform("open", "surroundings: " + path, now_s());
    }
    model_.scene->environment = before;
    model_.notices.complain("open", changed.error().message);
}

// 0: as the maps are, with the profile that the scene came with.
void Session::choose_tone(int tone) {
    if (!model_.scene) return;
    Skin& skin = model_.scene->skin;
    if (tone == 0) {
        skin.albedo_tint_linear = file_look_.skin.albedo_tint_linear;
        skin.profile = file_look_.skin.profile;
        model_.tone = 0;
        return;
    }
    const std::string name = tone_profile(tone);
    const Result<Profile> profile = find_profile(name);
    if (!mean_albedo_) {
        const Result<Vec3> mean = mean_skin_albedo(*model_.scene);
        if (!mean) return model_.notices.complain("tone", mean.error().message);
        mean_albedo_ = *mean;
    }
    if (!profile) return model_.notices.complain("tone", profile.error().message);
    skin.albedo_tint_linear = tint_towards(skin_tone_albedo_linear(tone), *mean_albedo_);
    skin.profile = name;
    model_.tone = tone;
}

// Materials hold the tint; the profile is asked for at every drawing.
void Session::follow_skin() {
    if (!stage_ || model_.scene->skin.albedo_tint_linear == drawn_tint_) return;
    drawn_tint_ = model_.scene->skin.albedo_tint_linear;
    stage_->skin_changed();
}

void Session::copy_view() {
    if (!model_.scene) return;
    const PictureSize size = picture_size();
    const std::string line = view_line(
        model_, file_look_, {.width = size.width, .height = size.height, .samples = stage_->samples()});
    window_.set_clipboard(line);
    (void)apply_view_line(model_, line);  // rounded as the line is, so that both draw the same
    model_.notices.inform("view", "copied: a command line that draws this picture", now_s());
}

void Session::paste_view() {
    if (!model_.scene) return;
    const Environment before = model_.scene->environment;
    Result<void> pasted = apply_view_line(model_, window_.clipboard());
    const Environment& around = model_.scene->environment;
    if (pasted && (around.kind != before.kind || around.file != before.file)) {
        pasted = stage_->environment_changed();
        if (!pasted) model_.scene->environment = before;
    }
    if (model_.scene->skin.profile != tone_profile(model_.tone)) model_.tone = 0;
    if (pasted)
        model_.notices.inform("view", "pasted", now_s());
    else
        model_.notices.inform("view", pasted.error().message, now_s());
}

Result<void> Session::save_scene(const std::string& path) {
    if (!model_.scene) return Error{"no scene to save yet"};
    const fs::path directory = fs::absolute(path).parent_path();
    const Result<std::string> text = scene_text(model_, directory);
    return text ? write_text_file(path, *text) : text.error();
}

std::string Session::free_name(const std::string& stem, const std::string& extension) const {
    std::error_code ec;
    for (int number = 1;; ++number) {
        const std::string digits = std::to_string(number);
        const std::string zeros(digits.size() < 3 ? 3 - digits.size() : 0, '0');
        const std::string name = stem + "-" + zeros + digits + extension;
        if (!fs::exists(name, ec)) return name;
    }
}

// What is under the mouse, measured anew when the mouse or the camera has moved.
std::string Session::probe_line() {
    const Region area = picture_area();
    const bool inside = mouse_px_.x >= area.x && mouse_px_.x < area.x + area.width && mouse_px_.y >= area.y &&
                        mouse_px_.y < area.y + area.height;
    if (!model_.scene || !inside || drag_ != Drag::none) return "";
    Vec2 place = {(mouse_px_.x - area.x) / area.width, (mouse_px_.y - area.y) / area.height};
    if (model_.compare == Compare::side_by_side) place.x = std::fmod(place.x * 2, 1.0f);
    const PictureSize size = picture_size();
    const std::string key = to_text(place.x) + ' ' + to_text(place.y) + ' ' +
                            camera_text(model_.scene->camera) + std::to_string(size.width) + 'x' +
                            std::to_string(size.height);
    if (key == probe_key_) return probe_text_;
    probe_key_ = key;
    if (!probe_) {
        Result<Probe> probe = Probe::create(*model_.scene);
        if (!probe) return probe_text_ = "";
        probe_.emplace(std::move(*probe));
    }
    const auto reading = probe_->at(model_.scene->camera, place, float(size.width) / float(size.height));
    return probe_text_ = reading ? probe_text(*reading) : "";
}

}  // namespace dermis::view
