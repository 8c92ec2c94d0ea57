#pragma once
// The parts of an open window, each with one duty. Actions (perform.h) and script commands
// (script_commands.h) work on all of them; a frame (session.h) calls them in order.

#include <memory>
#include <optional>

#include "dermis/view/clock.h"
#include "dermis/view/history.h"
#include "dermis/view/input.h"
#include "dermis/view/interface.h"
#include "dermis/view/motion.h"
#include "dermis/view/opener.h"
#include "dermis/view/pictures.h"
#include "dermis/view/presenter.h"
#include "dermis/view/reference.h"
#include "dermis/view/script_player.h"
#include "dermis/view/viewer.h"

namespace dermis::view {

struct Parts {
    /// Opens the window and a device while the first scene loads. `options` must outlive it.
    [[nodiscard]] static Result<std::unique_ptr<Parts>> open(const ViewerOptions& options);
    Parts(const ViewerOptions& options, const Clock& clock, Window window, gpu::Device device,
          std::future<Result<Start>> first);
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

    const ViewerOptions& options;
    Clock clock;
    // In this order: what is below is destroyed before what is above.
    Window window;
    gpu::Device device;
    std::optional<Presenter> presenter;  ///< there once open() is done, as `interface` is
    std::optional<Interface> interface;
    Model model;
    Pictures pictures;
    Reference reference;  ///< the reference job
    Opener opener;
    History history;
    RestingPose resting_pose;
    Input input;
    ScriptPlayer player;
    WidgetMap widgets;
    bool quit = false;

    /// The window's part that has the pictures, and the size of one.
    [[nodiscard]] Region picture_area() const;
    [[nodiscard]] PictureSize picture_size() const;
    [[nodiscard]] bool has_final_pictures() const { return pictures.are_final(model, reference.texture()); }
    /// Something is computed in the background, to which the window leaves the processor.
    [[nodiscard]] bool is_working() const { return reference.is_making() || pictures.are_walking(); }
    /// They are final, and nothing is on its way that would change them.
    [[nodiscard]] bool is_settled() const;
};

}  // namespace dermis::view
