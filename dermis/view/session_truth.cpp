// The ground truth, or any picture, on the right side.

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/image/tone_map.h"
#include "dermis/judge/comparison.h"
#include "dermis/scene/scene_hash.h"
#include "dermis/view/session.h"

namespace dermis::view {
namespace {

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
    asked_view_ = hash_of_views(*model_.scene);
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
    model_.truth_is_of_another_view = !truth_view_.empty() && truth_view_ != hash_of_views(*model_.scene);
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

}  // namespace dermis::view
