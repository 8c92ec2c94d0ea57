#include "dermis/view/reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/image/tone_map.h"
#include "dermis/judge/comparison.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::view {
namespace {

constexpr const char* kReferenceName = "reference";

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

void Reference::put(Image picture, std::string view, const std::string& name, Model& model) {
    picture_ = std::move(picture);
    view_ = std::move(view);
    texture_key_.clear();
    model.reference_path = name;
    if (!model.compares()) model.compare = Compare::wipe;
}

void Reference::open(const std::string& path, Model& model) {
    Result<LoadedImage> loaded = read_image(path, ImageUse::color);
    if (!loaded) return model.notices.report_error("open", loaded.error().message);
    put(std::move(loaded->image), "", path, model);
}

// Computed from a copy of the scene, or read from the cache.
void Reference::ask(const Model& model, PictureSize size) {
    if (!model.scene) return;
    if (making_.valid()) {
        stop_ = true;
        return;
    }
    const ReferenceSettings settings = comparison_settings(size.width, size.height).reference;
    stop_ = false;
    done_ = 0;
    shows_preview_ = false;
    preview_ = Image();
    asked_view_ = hash_of_views(*model.scene);
    making_ = std::async(std::launch::async, [this, settings, scene = *model.scene] {
        return cached_reference(
            scene, settings, [this](double done) { done_ = float(done); }, &stop_,
            [this](const Image& radiance) {
                const std::lock_guard lock(preview_mutex_);
                preview_ = radiance;
            });
    });
}

bool Reference::is_replaced(const Model& model) const {
    return shows_preview_ && model.reference_path != kReferenceName;
}

// A comparison that was switched off meanwhile stays so.
void Reference::show(Image radiance, Model& model) {
    if (!shows_preview_) return put(std::move(radiance), asked_view_, kReferenceName, model);
    picture_ = std::move(radiance);
    texture_key_.clear();
}

bool Reference::take_preview(Model& model) {
    if (is_replaced(model)) stop_ = true;
    Image latest;
    {
        const std::lock_guard lock(preview_mutex_);
        latest = std::exchange(preview_, Image());
    }
    if (latest.empty() || stop_) return false;
    show(std::move(latest), model);
    shows_preview_ = true;
    return true;
}

bool Reference::take(Model& model, double now_s) {
    if (!making_.valid()) return false;
    if (making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        model.notices.inform("reference", "reference: " + std::to_string(int(done_ * 100)) + " %   (G stops)",
                             now_s);
        return take_preview(model);
    }
    Result<CachedReference> made = making_.get();
    model.notices.clear("reference");
    if (is_replaced(model)) return true;
    if (made)
        show(std::move(made->picture.radiance), model);
    else if (!stop_)
        model.notices.report_error("reference", made.error().message);
    return true;
}

Result<void> Reference::refresh(gpu::Device& device, Model& model) {
    if (model.reference_path.empty()) picture_ = Image();
    if (picture_.empty() || !model.scene) {
        texture_.reset();
        model.reference_is_of_another_view = false;
        return {};
    }
    model.reference_is_of_another_view = !view_.empty() && view_ != hash_of_views(*model.scene);
    const std::string key =
        model.reference_path + to_text(model.scene->exposure_ev) + std::to_string(int(model.scene->tone_map));
    if (texture_ && key == texture_key_) return {};
    DERMIS_TRY_ASSIGN(gpu::Texture texture,
                      gpu::Texture::upload(device, texture_data(for_display(picture_, *model.scene))));
    texture_.emplace(std::move(texture));
    texture_key_ = key;
    return {};
}

}  // namespace dermis::view
