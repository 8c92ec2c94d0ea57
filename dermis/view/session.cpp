#include "dermis/view/session.h"

namespace dermis::view {

Session::Session(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
    if (parts_->options.keeps_state) state_ = load_state();
    parts_->model.recent = state_.recent;
    report_.device = parts_->device.info().name;
}

Result<Session> Session::open(const ViewerOptions& options) {
    DERMIS_TRY_ASSIGN(std::unique_ptr<Parts> parts, Parts::open(options));
    return Session(std::move(parts));
}

Result<ViewerReport> Session::run() {
    Parts& p = *parts_;
    while (!p.quit && !p.window.should_close()) {
        DERMIS_TRY(frame());
        p.clock.end_frame();
        if (p.options.frames > 0 && p.clock.frames() >= p.options.frames) break;
    }
    report_.frames = p.clock.frames();
    p.opener.wait();
    if (p.options.keeps_state) {
        state_.width = p.presenter->size().width;
        state_.height = p.presenter->size().height;
        store_state(state_);
    }
    if (!p.device.messages().empty()) return Error{"the validation layers reported errors (see above)"};
    return report_;
}

void Session::hand_over(ViewerOptions& options) const {
    const Parts& p = *parts_;
    Start start = {.scene = *p.model.scene,
                   .lacks_bakes = p.pictures.scene().stage().lacks_bakes(),
                   .loading_words = p.model.loading_words,
                   .file_look = p.pictures.scene().file_look(),
                   .handed = Handed{.model = p.model,
                                    .reference = p.reference.picture(),
                                    .reference_view = p.reference.view(),
                                    .loaded_pose = p.pictures.scene().loaded_pose()}};
    start.handed->model.scene = nullptr;
    options.load = [start = std::move(start)]() -> Result<Start> { return start; };
    options.scene_path = p.model.scene_path;
    options.size = p.presenter->size();
    options.script.erase(options.script.begin(), options.script.begin() + std::ptrdiff_t(p.player.begun()));
}

Result<ViewerReport> run_viewer(const ViewerOptions& options) {
    // A scene that makes the driver fail would lose the device again and again.
    constexpr int kMostLosses = 3;
    ViewerOptions current = options;
    for (int losses = 0;; ++losses) {
        Result<Session> session = Session::open(current);
        if (!session) return session.error();
        Result<ViewerReport> report = session->run();
        const bool lost = !report && report.error().code == ErrorCode::device_lost;
        if (!lost || losses == kMostLosses || !session->has_scene()) return report;
        session->hand_over(current);
        // The loss was the last command: nothing else would end the window.
        if (!options.script.empty() && current.script.empty() && current.frames == 0) current.frames = 1;
    }
}

}  // namespace dermis::view
