#include "dermis/view/session.h"

#include "dermis/base/text.h"

namespace dermis::view {
namespace {

constexpr double kScriptFrameS = 1.0 / 30;

}  // namespace

Session::Session(const ViewerOptions& options, Window window, gpu::Device device,
                 std::future<Result<Start>> first)
    : options_(&options),
      window_(std::move(window)),
      device_(std::move(device)),
      shaders_(gpu::embedded_shaders(options.catalog.shaders),
               options.shader_root.empty() ? std::string(DERMIS_SOURCE_DIR) : options.shader_root),
      loader_(std::move(first), options.scene_path, options.catalog.subjects),
      input_(!options.script.empty()),
      player_(options.script, options.script_name),
      model_{.catalog = options.catalog,
             .choices = {TechniqueChoice(options.catalog.techniques.front()),
                         TechniqueChoice(options.catalog.techniques.front())}} {}

Result<std::unique_ptr<Session>> Session::open(const ViewerOptions& options) {
    std::future<Result<Start>> loading = std::async(std::launch::async, options.load);
    Result<Window> window = Window::open("Dermis", options.size);
    if (!window) return window.error();
    Result<gpu::Device> device = gpu::Device::create({.validation = options.validation,
                                                      .name_contains = options.device,
                                                      .instance_extensions = window->instance_extensions()});
    if (!device) return device.error();
    std::unique_ptr<Session> session(
        new Session(options, std::move(*window), std::move(*device), std::move(loading)));
    session->report_.device = session->device_.info().name;
    if (options.keeps_state) session->state_ = load_state();
    session->model_.recent = session->state_.recent;
    if (Result<void> made = session->make_window_side(); !made) return made.error();
    return session;
}

Result<void> Session::make_window_side() {
    Result<Presenter> presenter =
        Presenter::create(device_, window_, gpu::embedded_shaders(options_->catalog.shaders));
    if (!presenter) return presenter.error();
    presenter_.emplace(std::move(*presenter));
    Result<Interface> interface =
        Interface::create(device_, {.get = [this] { return window_.clipboard(); },
                                    .set = [this](const std::string& text) { window_.set_clipboard(text); }});
    if (!interface) return interface.error();
    interface_.emplace(std::move(*interface));
    return {};
}

double Session::now_s() const {
    // A script's time goes by frames, so that it does the same on every machine.
    if (player_.has_script()) return report_.frames * kScriptFrameS;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

Result<ViewerReport> Session::run() {
    while (!quit_ && !window_.should_close()) {
        if (Result<void> ran = frame(); !ran) return ran.error();
        ++report_.frames;
        if (options_->frames > 0 && report_.frames >= options_->frames) break;
    }
    loader_.wait();
    if (options_->keeps_state) {
        state_.width = presenter_->size().width;
        state_.height = presenter_->size().height;
        store_state(state_);
    }
    if (const std::vector<std::string> said = device_.messages(); !said.empty())
        return Error{"the validation layers reported errors: " + join(said, "; ")};
    return report_;
}

void Session::hand_over(ViewerOptions& options) {
    Start start = {.scene = *model_.scene,
                   .loading_words = model_.loading_words,
                   .file_look = shown_.file_look(),
                   .handed = Handed{.model = model_, .truth = truth_.picture(), .truth_view = truth_.view()}};
    start.handed->model.scene = nullptr;
    options.load = [start = std::move(start)]() -> Result<Start> { return start; };
    options.scene_path = model_.scene_path;
    options.size = presenter_->size();
    options.script.erase(options.script.begin(), options.script.begin() + std::ptrdiff_t(player_.begun()));
}

Result<ViewerReport> run_viewer(const ViewerOptions& options) {
    constexpr int kMostLosses = 3;  // a scene that the driver cannot stand would lose it for ever
    ViewerOptions current = options;
    for (int losses = 0;; ++losses) {
        Result<std::unique_ptr<Session>> session = Session::open(current);
        if (!session) return session.error();
        Result<ViewerReport> report = (*session)->run();
        const bool lost = !report && report.error().code == ErrorCode::device_lost;
        if (!lost || losses == kMostLosses || !(*session)->has_scene()) return report;
        (*session)->hand_over(current);
    }
}

}  // namespace dermis::view
