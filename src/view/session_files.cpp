// What comes from files and goes to them: scenes, panoramas, pictures to compare with, shaders that change.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/compare/comparison.h"
#include "dermis/image/io.h"
#include "dermis/image/tone_map.h"
#include "dermis/optics/presets.h"
#include "dermis/render/skin_tone.h"
#include "dermis/view/scene_edit.h"
#include "dermis/view/session.h"
#include "dermis/view/view_line.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

constexpr double kLookEveryS = 0.3;
constexpr const char* kShaderTopic = "shader ";

// Eight bits for the display: light through the scene's exposure and tone map, other pictures as they are.
Image for_display(const Image& picture, const Scene& scene) {
    Image linear = to_linear_float(picture);
    if (picture.format == PixelFormat::f16 || picture.format == PixelFormat::f32)
        linear = tone_mapped(linear, scene.tone_map, std::exp2(scene.exposure_ev));
    return convert(linear, PixelFormat::u8, Encoding::srgb);
}

gpu::TextureData texture_data(const Image& display) {
    gpu::TextureData data{.name = "compared picture", .width = display.width, .height = display.height};
    data.bytes.assign(display.pixel_count() * 4, std::byte{255});
    for (size_t i = 0; i < display.pixel_count(); ++i)
        for (int c = 0; c < 3; ++c)
            data.bytes[4 * i + size_t(c)] =
                display.bytes[i * size_t(display.channels) + size_t(display.channels >= 3 ? c : 0)];
    return data;
}

}  // namespace

void Session::load(const std::string& path) {
    if (loading_.valid()) return model_.notices.inform("open", "still loading " + loading_path_, now_s());
    loading_path_ = path;
    reloading_ = false;
    loading_ = std::async(std::launch::async, load_start, path);
}

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
    if (changed) return model_.notices.inform("open", "surroundings: " + path, now_s());
    model_.scene->environment = before;
    model_.notices.complain("open", changed.error().message);
}

void Session::open_truth(const std::string& path) {
    Result<LoadedImage> loaded = read_image(path, ImageUse::color);
    if (!loaded) return model_.notices.complain("open", loaded.error().message);
    truth_image_ = std::move(loaded->image);
    truth_key_.clear();
    model_.truth_path = path;
    truth_view_.clear();
    if (!model_.compares()) model_.compare = Compare::wipe;
}

// Beside the window's work, on a copy of the scene; found in the cache when dermis compare or an earlier G
// made it.
void Session::ask_for_truth() {
    if (!model_.scene) return;
    if (making_truth_.valid()) {
        stop_truth_ = true;
        return;
    }
    const PictureSize size = picture_size();
    const ReferenceSettings settings = comparison_settings(size.width, size.height).reference;
    stop_truth_ = false;
    truth_done_ = 0;
    asked_view_ = truth_key(*model_.scene);
    making_truth_ = std::async(std::launch::async, [this, settings, scene = *model_.scene] {
        return cached_reference(
            scene, settings, [this](double done) { truth_done_ = float(done); }, &stop_truth_);
    });
}

// True when one has come.
bool Session::take_truth() {
    if (!making_truth_.valid()) return false;
    if (making_truth_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        model_.notices.inform(
            "truth", "ground truth: " + std::to_string(int(truth_done_ * 100)) + " %   (G stops)", now_s());
        return false;
    }
    Result<CachedReference> made = making_truth_.get();
    model_.notices.clear("truth");
    if (!made) {
        if (!stop_truth_) model_.notices.complain("truth", made.error().message);
        return true;
    }
    truth_image_ = std::move(made->picture.radiance);
    truth_key_.clear();
    model_.truth_path = "ground truth";
    truth_view_ = asked_view_;
    if (!model_.compares()) model_.compare = Compare::wipe;
    return true;
}

// The texture of the right side follows exposure and tone map.
Result<void> Session::refresh_truth() {
    if (model_.truth_path.empty()) truth_image_ = Image();
    if (truth_image_.empty() || !model_.scene) {
        truth_.reset();
        model_.truth_is_of_another_view = false;
        return {};
    }
    model_.truth_is_of_another_view = !truth_view_.empty() && truth_view_ != truth_key(*model_.scene);
    const std::string key =
        model_.truth_path + to_text(model_.scene->exposure_ev) + std::to_string(int(model_.scene->tone_map));
    if (truth_ && key == truth_key_) return {};
    Result<gpu::Texture> texture =
        gpu::Texture::upload(device_, texture_data(for_display(truth_image_, *model_.scene)));
    if (!texture) return texture.error();
    truth_.emplace(std::move(*texture));
    truth_key_ = key;
    return {};
}

// 0: as the maps are, with the profile that the scene came with.
void Session::choose_tone(int tone) {
    if (!model_.scene) return;
    Skin& skin = model_.scene->skin;
    if (tone == 0) {
        skin.albedo_tint_linear = file_skin_.albedo_tint_linear;
        skin.profile = file_skin_.profile;
        model_.tone = 0;
        return;
    }
    const std::string name = "openpbr_skin_" + std::to_string(tone);
    const Result<Profile> profile = find_profile(name);
    if (!mean_albedo_) {
        const Result<Vec3> mean = mean_skin_albedo(*model_.scene);
        if (!mean) return model_.notices.complain("tone", mean.error().message);
        mean_albedo_ = *mean;
    }
    if (!profile) return model_.notices.complain("tone", profile.error().message);
    const Vec3 albedo = {float(diffuse_albedo(*profile, 0)), float(diffuse_albedo(*profile, 1)),
                         float(diffuse_albedo(*profile, 2))};
    skin.albedo_tint_linear = tint_towards(albedo, *mean_albedo_);
    skin.profile = name;
    model_.tone = tone;
}

// Materials hold the tint; the profile is asked for at every drawing.
void Session::follow_skin() {
    if (!stage_ || model_.scene->skin.albedo_tint_linear == drawn_tint_) return;
    drawn_tint_ = model_.scene->skin.albedo_tint_linear;
    stage_->skin_changed();
}

bool Session::follow_files() {
    bool changed = false;
    if (now_s() - last_look_s_ >= kLookEveryS) {
        last_look_s_ = now_s();
        if (shaders_.poll() && stage_) {
            stage_->forget_shaders();
            shaders_unproven_ = changed = true;
        }
        if (stage_ && !loading_.valid() && !scene_files_.changed().empty()) {
            load(model_.scene_path);
            reloading_ = changed = true;
        }
    }
    const std::vector<Notice> shown = model_.notices.all();
    for (const Notice& notice : shown)
        if (notice.topic.starts_with(kShaderTopic)) model_.notices.clear(notice.topic);
    for (const auto& [name, message] : shaders_.errors())
        model_.notices.complain(kShaderTopic + name, message + "  (the last good one goes on)");
    return changed;
}

void Session::copy_view() {
    if (!model_.scene) return;
    const PictureSize size = picture_size();
    window_.set_clipboard(view_line(model_, size.width, size.height));
    model_.notices.inform("view", "copied: a command line that draws this picture", now_s());
}

void Session::paste_view() {
    if (!model_.scene) return;
    const Result<void> pasted = apply_view_line(model_, window_.clipboard());
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
