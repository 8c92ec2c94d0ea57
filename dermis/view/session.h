#pragma once
// One run of the window, from opening to closing: frame after frame over its parts.

#include <memory>

#include "dermis/view/parts.h"
#include "dermis/view/state_file.h"

namespace dermis::view {

class Session {
  public:
    [[nodiscard]] static Result<Session> open(const ViewerOptions& options);
    [[nodiscard]] Result<ViewerReport> run();
    [[nodiscard]] bool has_scene() const { return parts_->model.scene != nullptr; }
    /// State with which another session continues this one.
    void hand_over(ViewerOptions& options) const;

  private:
    explicit Session(std::unique_ptr<Parts> parts);

    // session_frame.cpp
    [[nodiscard]] Result<void> frame();
    [[nodiscard]] Result<void> take_scene();
    void step_motion();
    [[nodiscard]] Result<PanelRequests> show_interface(const std::vector<Event>& events,
                                                       InterfaceDraws& draws);
    [[nodiscard]] Result<void> show_pictures(const InterfaceDraws& draws);
    [[nodiscard]] Result<void> step_script();

    std::unique_ptr<Parts> parts_;
    WindowState state_;
    ViewerReport report_;
    double last_frame_s_ = 0, last_step_s_ = 0;
};

}  // namespace dermis::view
