#include "dermis/view/stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dermis::view {
namespace {

// Estimates for the first frame: the time of the skin on a processor and on a graphics card.
constexpr double kProcessorMsPerMegapixel = 600, kCardMsPerMegapixel = 3;

double megapixels(PictureSize size) {
    return double(size.width) * size.height * 1e-6;
}

}  // namespace

Result<Stage> Stage::create(gpu::Device& device, const gpu::ShaderSource& shaders,
                            std::unique_ptr<Scene> scene, int samples) {
    Stage stage;
    stage.device_ = &device;
    stage.shaders_ = shaders;
    stage.scene_ = std::move(scene);
    stage.limits_.samples = std::ranges::count(device.info().sample_counts, samples) ? samples : 1;
    DERMIS_TRY_ASSIGN(Renderer first, Renderer::create(device, shaders, *stage.scene_));
    stage.sides_[0].renderer.emplace(std::move(first));
    for (Side& side : stage.sides_)
        side.ladder.emplace(device.info().is_cpu ? kProcessorMsPerMegapixel : kCardMsPerMegapixel);
    return stage;
}

Result<Renderer*> Stage::renderer(size_t choice) {
    Side& side = sides_[choice];
    if (!side.renderer) {
        DERMIS_TRY_ASSIGN(Renderer second, sides_[0].renderer->sibling(shaders_));
        side.renderer.emplace(std::move(second));
    }
    return &*side.renderer;
}

DrawSettings Stage::settings(const Model& model, PictureSize size, Quality quality) const {
    const auto scaled = [&](int side) { return std::max(1, int(std::lround(float(side) * quality.scale))); };
    return {.width = scaled(size.width),
            .height = scaled(size.height),
            .samples = quality.samples,
            .view = model.view,
            .shadow_map_size = quality.scale < 1 ? 1024 : 2048};
}

QualityLimits Stage::limits() const {
    QualityLimits limits = limits_;
    if (lacks_bakes()) limits.samples = 1;  // the processor is left to the bakes
    return limits;
}

void Stage::take_walks() {
    if (walks_.take()) invalidate();
}

Result<bool> Stage::refresh(Model& model, size_t choice, PictureSize size, double now_s) {
    Side& side = sides_[choice];
    const std::string key =
        picture_key(model, choice) + std::to_string(size.width) + 'x' + std::to_string(size.height);
    const bool changed = key != side.key;
    if (changed) {
        side.key = key;
        side.changed_s = now_s;
        side.failed = false;
    }
    if (side.failed) return false;
    const std::optional<Quality> quality =
        side.ladder->due(changed, now_s - side.changed_s, megapixels(size), limits());
    if (!quality) return false;
    DERMIS_TRY_ASSIGN(Renderer* const drawer, renderer(choice));
    DrawSettings draw = settings(model, size, *quality);
    if (lacks_bakes()) draw.view = "final";
    fit_depth_range(scene_->camera, scene_->bounds_center_mm, scene_->bounds_radius_mm);
    const Technique& technique = lacks_bakes() ? *baseline_ : model.choices[choice].technique();
    ParameterValues chosen =
        lacks_bakes() ? ParameterValues(technique.parameters) : model.choices[choice].values();
    side.lacks_walks = !lacks_bakes() && !walks_.have(*scene_, gain_of(chosen));
    if (side.lacks_walks) chosen = with_gain(std::move(chosen), Gain::curvature);
    const bool coarse = quality->scale < 1 && technique.coarse;
    const Result<uint64_t> frame =
        drawer->submit(technique, coarse ? technique.coarse(chosen, quality->scale) : chosen, draw);
    side.failed = !frame;
    if (!frame) return frame.error();
    side.ladder->drawn(*quality);
    side.in_flight.push_back({*frame, *quality, megapixels(size)});
    side.picture.quality = *quality;
    side.picture.width = draw.width;
    side.picture.height = draw.height;
    side.picture.passes = drawer->list().passes.size();
    return true;
}

Result<bool> Stage::take_times(size_t choice) {
    Side& side = sides_[choice];
    if (side.in_flight.empty()) return false;
    Result<std::vector<gpu::FrameResult>> finished = side.renderer->finished();
    if (!finished) {
        side.in_flight.clear();
        return finished.error();
    }
    for (gpu::FrameResult& result : *finished) {
        const auto drawing = std::ranges::find(side.in_flight, result.frame, &Drawing::frame);
        if (drawing == side.in_flight.end()) continue;
        side.ladder->measured(drawing->quality, drawing->megapixels, result.frame_ms);
        side.in_flight.erase(side.in_flight.begin(), drawing + 1);
        side.picture.timings = std::move(result);
    }
    return !finished->empty();
}

std::optional<gpu::ForeignImage> Stage::image(size_t choice) const {
    const Side& side = sides_[choice];
    if (side.picture.width == 0) return {};
    return gpu::ForeignImage{&const_cast<Renderer&>(*side.renderer).executor(), "display"};
}

bool Stage::is_final(size_t choice) const {
    const Side& side = sides_[choice];
    return side.failed || (side.in_flight.empty() && side.ladder->is_final(limits()));
}

Result<void> Stage::write(Model& model, size_t choice, PictureSize size, const std::filesystem::path& path) {
    const OutputSettings output = {.credit = scene_->credit,
                                   .description = scene_->name + ", " + model.choices[choice].technique().id};
    DERMIS_TRY(check_output(path, output));
    DERMIS_TRY_ASSIGN(Renderer* const drawer, renderer(choice));
    const DrawSettings draw = settings(model, size, {.samples = limits_.samples});
    TechniqueChoice& chosen = model.choices[choice];
    walks_.wait();
    fit_depth_range(scene_->camera, scene_->bounds_center_mm, scene_->bounds_radius_mm);
    DERMIS_TRY(drawer->draw(chosen.technique(), chosen.values(), draw));
    return write_output(*drawer, chosen.technique(), chosen.values(), draw, path, output);
}

void Stage::add_warnings(Warnings& warnings) const {
    warnings.add(scene_->warnings);
    for (const Side& side : sides_)
        if (side.renderer) warnings.add(side.renderer->warnings());
}

void Stage::skin_changed() {
    sides_[0].renderer->materials_changed();
    invalidate();
}

Result<void> Stage::environment_changed() {
    invalidate();
    return sides_[0].renderer->environment_changed();
}

Result<bool> Stage::pose_on_device(const ScenePoser& poser, const Pose& pose) {
    invalidate();
    if (sides_[1].renderer) sides_[1].renderer->drop_history();
    return sides_[0].renderer->pose_on_device(poser, pose);
}

Result<void> Stage::vertices_moved() {
    invalidate();
    if (sides_[1].renderer) sides_[1].renderer->drop_history();
    return sides_[0].renderer->vertices_moved();
}

Result<void> Stage::replace_objects(Scene loaded) {
    invalidate();
    walks_.forget();
    baseline_ = nullptr;
    scene_->objects = std::move(loaded.objects);
    scene_->rest_objects = std::move(loaded.rest_objects);
    scene_->bounds_center_mm = loaded.bounds_center_mm;
    scene_->bounds_radius_mm = loaded.bounds_radius_mm;
    scene_->warnings = std::move(loaded.warnings);
    if (sides_[1].renderer) sides_[1].renderer->forget_shape();
    return sides_[0].renderer->objects_replaced();
}

void Stage::invalidate() {
    for (Side& side : sides_) side.key.clear();
}

void Stage::forget_shaders() {
    for (Side& side : sides_)
        if (side.renderer) side.renderer->executor().forget_shaders();
    invalidate();
}

}  // namespace dermis::view
