#include "dermis/view/session.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "dermis/base/text.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/scene_paths.h"

namespace dermis::view {
namespace {

constexpr double kScriptFrameS = 1.0 / 30;
constexpr size_t kHistoryFrames = 90;
constexpr float kDesignHeightPx = 900;  // the window's height at which the interface has scale 1

// The baseline, or against the baseline the technique after it.
const Technique& compared_with(const Technique& technique) {
    const std::span<const Technique> all = all_techniques();
    const auto baseline = std::ranges::find(all, "lambert", &Technique::id);
    if (baseline != all.end() && technique.id != baseline->id) return *baseline;
    return all[1 % all.size()];
}

// In steps of a quarter: a font is made for each.
float automatic_scale(float content_scale, int height) {
    const float by_height = std::floor(float(height) / kDesignHeightPx * 4) / 4;
    return std::clamp(std::max(content_scale, by_height), 1.0f, 4.0f);
}

}  // namespace

Result<Start> load_start(const std::string& path) {
    Result<Scene> scene = load_scene(path);
    if (!scene) return scene.error();
    if (Result<void> completed = complete_scene(*scene); !completed) return completed.error();
    return Start{.scene = std::move(*scene)};
}

Session::Session(const ViewerOptions& options, Window window, gpu::Device device)
    : options_(&options),
      window_(std::move(window)),
      device_(std::move(device)),
      shaders_(options.shader_root.empty() ? std::string(DERMIS_SOURCE_DIR) : options.shader_root),
      model_{.choices = {TechniqueChoice(all_techniques().front()),
                         TechniqueChoice(all_techniques().front())}} {}

Result<std::unique_ptr<Session>> Session::open(const ViewerOptions& options) {
    std::future<Result<Start>> loading = std::async(std::launch::async, options.load);
    Result<Window> window = Window::open("Dermis", options.size);
    if (!window) return window.error();
    Result<gpu::Device> device = gpu::Device::create({.validation = options.validation,
                                                      .name_contains = options.device,
                                                      .instance_extensions = window->instance_extensions()});
    if (!device) return device.error();
    std::unique_ptr<Session> session(new Session(options, std::move(*window), std::move(*device)));
    session->loading_ = std::move(loading);
    session->loading_path_ = options.scene_path;
    session->report_.device = session->device_.info().name;
    if (options.keeps_state) session->state_ = load_state();
    session->model_.recent = session->state_.recent;
    if (Result<void> made = session->make_window_side(); !made) return made.error();
    return session;
}

Result<void> Session::make_swapchain() {
    Result<gpu::Swapchain> swapchain =
        gpu::Swapchain::create(device_, window_.surface_maker(),
                               {.width = size_.width,
                                .height = size_.height,
                                .pacing = model_.vsync ? gpu::Pacing::vsync : gpu::Pacing::immediate});
    if (!swapchain) return swapchain.error();
    swapchain_.emplace(std::move(*swapchain));
    return {};
}

Result<void> Session::make_window_side() {
    size_ = window_.framebuffer();
    if (Result<void> made = make_swapchain(); !made) return made;
    Result<gpu::Executor> executor = gpu::Executor::create(device_, gpu::embedded_shaders());
    if (!executor) return executor.error();
    executor_.emplace(std::move(*executor));
    Result<Interface> interface =
        Interface::create(device_, {.get = [this] { return window_.clipboard(); },
                                    .set = [this](const std::string& text) { window_.set_clipboard(text); }});
    if (!interface) return interface.error();
    interface_.emplace(std::move(*interface));
    return {};
}

double Session::now_s() const {
    // A script's time goes by frames, so that it does the same on every machine.
    if (!options_->script.empty()) return report_.frames * kScriptFrameS;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

Region Session::picture_area() const {
    return picture_region(model_, size_.width, size_.height, interface_->scale());
}

PictureSize Session::picture_size() const {
    const Region area = picture_area();
    const float share = model_.compare == Compare::side_by_side ? 0.5f : 1;
    return {std::max(1, int(area.width * share)), std::max(1, int(area.height))};
}

Result<void> Session::take_loaded() {
    if (!loading_.valid()) return {};
    if (loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
    const bool first = !stage_;
    Result<Start> start = loading_.get();
    if (reloading_ && stage_ && start &&
        camera_text(start->scene.camera) == file_camera_)  // the file says nothing new of it
        start->scene.camera = model_.scene->camera;
    if (start) {
        const Result<void> begun = begin_scene(std::move(*start), first);
        if (begun || first) return begun;
        model_.notices.complain("open", begun.error().message);
        return {};
    }
    if (first) return start.error();
    model_.notices.complain("open", start.error().message);
    return {};
}

Result<void> Session::begin_scene(Start start, bool first) {
    auto scene = std::make_unique<Scene>(std::move(start.scene));
    if (!reloading_) file_camera_ = camera_text(scene->camera);
    Result<Stage> stage = Stage::create(device_, shaders_.source(), std::move(scene), options_->samples);
    if (!stage) return stage.error();
    model_.scene = nullptr;
    probe_.reset();
    probe_key_.clear();
    stage_.emplace(std::move(*stage));
    model_.scene = &stage_->scene();
    model_.scene_path = loading_path_;
    file_skin_ = model_.scene->skin;
    drawn_tint_ = file_skin_.albedo_tint_linear;
    mean_albedo_.reset();
    model_.tone = 0;
    follow_scene(first);
    if (first) {
        if (start.technique) {
            model_.choices[0].choose(*start.technique);
            if (start.values) model_.choices[0].values() = *start.values;
            model_.choices[1].choose(compared_with(*start.technique));
        }
        model_.view = start.view;
        if (!options_->truth.empty()) open_truth(options_->truth);
    }
    model_.notices.clear("open");
    for (const std::string& warning : model_.scene->warnings)
        model_.notices.inform("warning", warning, now_s());
    window_.set_title(model_.scene->name + " - Dermis");
    return {};
}

// Watches the scene's file, takes the technique that it asks for, remembers it.
void Session::follow_scene(bool first) {
    const std::filesystem::path by_name = find_scene(model_.scene_path);
    scene_files_.watch({by_name.empty() ? std::filesystem::path(model_.scene_path) : by_name});
    remember(state_, model_.scene_path);
    model_.recent = state_.recent;
    const Scene& scene = *model_.scene;
    if (!first && !reloading_ && !scene.technique.empty()) {
        const Result<const Technique*> technique = find_technique(scene.technique);
        if (!technique) model_.notices.complain("technique", technique.error().message);
        if (technique) {
            model_.choices[0].choose(**technique);
            for (const auto& [name, text] : scene.settings)
                if (const Result<void> set = model_.choices[0].values().set(name, text); !set)
                    model_.notices.complain("technique", set.error().message);
        }
    }
    reloading_ = false;
}

Result<void> Session::rescale() {
    const float scale = options_->interface_scale > 0
                            ? options_->interface_scale
                            : automatic_scale(window_.content_scale(), size_.height);
    return interface_->set_scale(std::clamp(scale * model_.user_scale, 0.5f, 6.0f));
}

PanelFacts Session::facts() const {
    PanelFacts facts = {.scale = interface_->scale(),
                        .width = size_.width,
                        .height = size_.height,
                        .device = report_.device,
                        .frame_history_ms = history_ms_,
                        .loading = loading_.valid(),
                        .probe = probe_text_};
    facts.picture_state = facts.device;
    if (!stage_ || stage_->picture(0).width == 0) return facts;
    const Picture& picture = stage_->picture(0);
    facts.picture_state = std::to_string(picture.width) + " x " + std::to_string(picture.height) + "   " +
                          std::to_string(picture.quality.samples) +
                          (picture.quality.samples > 1 ? " samples   " : " sample   ") + facts.device;
    facts.frame_ms = picture.timings.frame_ms;
    for (const gpu::PassTiming& pass : picture.timings.passes)
        facts.passes.push_back({pass.name, pass.time_ms});
    return facts;
}

Result<void> Session::refresh_pictures() {
    drew_ = false;
    if (!stage_) return {};
    follow_skin();
    if (Result<void> made = refresh_truth(); !made) return made;
    const size_t sides = model_.compares() && !truth_ ? 2 : 1;
    for (size_t side = 0; side < sides; ++side) {
        const Result<bool> drew = stage_->refresh(model_, side, picture_size(), now_s());
        const std::string topic = "picture " + std::to_string(side);
        if (!drew) {
            // Shaders that compile and do not fit together are taken back; anything else is told.
            if (shaders_unproven_ && shaders_.take_back(drew.error().message))
                stage_->forget_shaders();
            else
                model_.notices.complain(topic, drew.error().message);
            continue;
        }
        if (!*drew) continue;
        model_.notices.clear(topic);
        if (shaders_unproven_) shaders_.confirm();
        shaders_unproven_ = false;
        drew_ = true;
        if (side > 0) continue;
        history_ms_.push_back(float(stage_->picture(0).timings.frame_ms));
        if (history_ms_.size() > kHistoryFrames) history_ms_.erase(history_ms_.begin());
    }
    return {};
}

Result<void> Session::show(const InterfaceDraws& draws) {
    if (!swapchain_)  // its pacing was changed
        if (Result<void> made = make_swapchain(); !made) return made;
    const auto a = stage_ ? stage_->image(0) : std::nullopt;
    const auto b = stage_ && model_.compares() && !truth_ ? stage_->image(1) : std::nullopt;
    const bool two = model_.compares() && (b || truth_);
    gpu::FrameInputs inputs = {.width = size_.width, .height = size_.height, .draws = draws.draws};
    Arrangement arrangement = Arrangement::none;
    if (a) {
        arrangement = Arrangement::one;
        if (two && model_.compare == Compare::wipe) arrangement = Arrangement::wipe;
        if (two && model_.compare == Compare::side_by_side) arrangement = Arrangement::side_by_side;
        inputs.images["picture_a"] = *a;
        if (truth_)
            inputs.textures["picture_b"] = &*truth_;
        else
            inputs.images["picture_b"] = b ? *b : *a;
    }
    const PassList list = window_passes({.width = size_.width,
                                         .height = size_.height,
                                         .region = picture_area(),
                                         .arrangement = arrangement,
                                         .split = model_.split,
                                         .line_px = std::max(1.0f, std::round(interface_->scale())),
                                         .has_interface = !draws.draws.empty()});
    if (const auto run = executor_->run(list, inputs); !run) return run.error();
    const Result<gpu::Presented> presented = swapchain_->present(*executor_, "window");
    if (!presented) return presented.error();
    if (*presented == gpu::Presented::resize) return swapchain_->resize(size_.width, size_.height);
    if (a && report_.first_picture_s == 0)
        report_.first_picture_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    return {};
}

bool Session::is_settled() const {
    if (loading_.valid() || making_truth_.valid() || !stage_ || drew_) return false;
    return stage_->is_final(0) && (!model_.compares() || truth_ || stage_->is_final(1));
}

// Nothing has happened and nothing is on its way: the window shows what it would show again.
bool Session::may_rest(const std::vector<Event>& events, WindowSize size) const {
    return events.empty() && awake_frames_ == 0 && size == size_ && options_->script.empty() &&
           options_->frames == 0 && model_.notices.all().empty() && is_settled();
}

Result<void> Session::frame() {
    const std::vector<Event> events = gather_events();
    if (Result<void> taken = take_loaded(); !taken) return taken;
    if (follow_files()) awake_frames_ = kAwakeFrames;
    if (take_truth()) awake_frames_ = kAwakeFrames;
    const WindowSize size = window_.framebuffer();
    if (may_rest(events, size)) return {};
    if (size.width == 0 || size.height == 0) {  // minimised
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return step_script();
    }
    if (size != size_) {
        size_ = size;
        if (Result<void> resized = swapchain_->resize(size.width, size.height); !resized) return resized;
    }
    if (Result<void> scaled = rescale(); !scaled) return scaled;
    model_.notices.expire(now_s());
    interface_->begin(events, size.width, size.height, std::max(now_s() - last_frame_s_, 1e-3));
    last_frame_s_ = now_s();
    take_input(events);
    probe_text_ = probe_line();
    PanelRequests requests;
    widgets_.clear();
    show_panels(model_, facts(), requests, widgets_);
    Result<InterfaceDraws> draws = interface_->end();
    if (!draws) return draws.error();
    for (const Action action : requests.actions) act(action);
    if (requests.tone) choose_tone(*requests.tone);
    if (!requests.open.empty()) open_file(requests.open);
    if (Result<void> refreshed = refresh_pictures(); !refreshed) return refreshed;
    if (Result<void> shown = show(*draws); !shown) return shown;
    return step_script();
}

Result<ViewerReport> Session::run() {
    while (!quit_ && !window_.should_close()) {
        if (Result<void> ran = frame(); !ran) return ran.error();
        ++report_.frames;
        if (options_->frames > 0 && report_.frames >= options_->frames) break;
    }
    if (loading_.valid()) loading_.wait();
    if (options_->keeps_state) {
        state_.width = size_.width;
        state_.height = size_.height;
        store_state(state_);
    }
    if (const std::vector<std::string> said = device_.messages(); !said.empty())
        return Error{"the validation layers complained: " + join(said, "; ")};
    return report_;
}

void Session::hand_over(ViewerOptions& options) {
    const Start start = {.scene = *model_.scene,
                         .technique = &model_.choices[0].technique(),
                         .values = model_.choices[0].values(),
                         .view = model_.view};
    options.load = [start]() -> Result<Start> { return start; };
    options.scene_path = model_.scene_path;
    options.size = size_;
    options.truth = model_.truth_path;
    options.script.erase(options.script.begin(), options.script.begin() + std::ptrdiff_t(next_command_));
}

Result<ViewerReport> run_viewer(const ViewerOptions& options) {
    constexpr int kMostLosses = 3;  // a scene that the driver cannot stand would lose it for ever
    ViewerOptions current = options;
    for (int losses = 0;; ++losses) {
        Result<std::unique_ptr<Session>> session = Session::open(current);
        if (!session) return session.error();
        Result<ViewerReport> report = (*session)->run();
        const bool lost = !report && report.error().message.find(kDeviceLost) != std::string::npos;
        if (!lost || losses == kMostLosses || !(*session)->has_scene()) return report;
        (*session)->hand_over(current);
    }
}

}  // namespace dermis::view
