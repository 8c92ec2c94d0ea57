#pragma once
// What lives while the window is open: the parts, and what goes from one to the other. session.cpp opens,
// runs and ends it, session_frame.cpp is one frame, session_scene.cpp takes scenes in and follows files,
// session_actions.cpp does what keys and panels ask for, session_commands.cpp what scripts do.

#include <chrono>
#include <memory>

#include "dermis/view/hot_shaders.h"
#include "dermis/view/input.h"
#include "dermis/view/interface.h"
#include "dermis/view/loader.h"
#include "dermis/view/picture_times.h"
#include "dermis/view/presenter.h"
#include "dermis/view/script_player.h"
#include "dermis/view/shown_scene.h"
#include "dermis/view/state_file.h"
#include "dermis/view/truth.h"
#include "dermis/view/viewer.h"

namespace dermis::view {

class Session {
  public:
    [[nodiscard]] static Result<std::unique_ptr<Session>> open(const ViewerOptions& options);
    [[nodiscard]] Result<ViewerReport> run();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    [[nodiscard]] bool has_scene() const { return model_.scene != nullptr; }
    /// What another session needs to go on where this one ended.
    void hand_over(ViewerOptions& options);

  private:
    Session(const ViewerOptions& options, Window window, gpu::Device device,
            std::future<Result<Start>> first);
    [[nodiscard]] Result<void> make_window_side();
    [[nodiscard]] double now_s() const;

    // session_frame.cpp
    [[nodiscard]] Result<void> frame();
    [[nodiscard]] std::vector<Event> gather_events();
    void take_input(const std::vector<Event>& events);
    [[nodiscard]] Result<PanelRequests> show_interface(const std::vector<Event>& events,
                                                       InterfaceDraws& draws);
    [[nodiscard]] Result<void> refresh_pictures();
    [[nodiscard]] Result<void> show(const InterfaceDraws& draws);
    [[nodiscard]] PanelFacts facts();
    [[nodiscard]] std::string probe_line();
    [[nodiscard]] PictureSize picture_size() const;
    [[nodiscard]] Region picture_area() const;
    /// The pictures are as good as they get.
    [[nodiscard]] bool is_drawn() const;
    /// And nothing is on its way that would change them.
    [[nodiscard]] bool is_settled() const;

    // session_scene.cpp
    void load(const std::string& path);
    [[nodiscard]] Result<void> take_loaded();
    [[nodiscard]] Result<void> begin_scene(Start start, bool first);
    void take_start(const Start& start);
    void take_technique(const Scene& file);
    void announce_scene();
    /// True when something changed.
    bool follow_files();
    bool follow_scene_files();

    // session_actions.cpp
    void act(Action action);
    void open_file(const std::string& path);
    void open_panorama(const std::string& path);
    void copy_view();
    void paste_view();
    [[nodiscard]] Result<void> save_scene(const std::string& path);
    void notify_written(const std::string& path, const Result<void>& written);

    // session_commands.cpp
    [[nodiscard]] Result<void> step_script();
    [[nodiscard]] Result<void> run_command(const ScriptCommand& command);
    [[nodiscard]] std::string state_text();

    const ViewerOptions* options_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
    // In this order: what is below is destroyed before what is above.
    Window window_;
    gpu::Device device_;
    std::optional<Presenter> presenter_;
    std::optional<Interface> interface_;
    HotShaders shaders_;
    ShownScene shown_;
    Truth truth_;
    Loader loader_;
    Input input_;
    ScriptPlayer player_;
    PictureTimes times_;

    Model model_;
    WidgetMap widgets_;
    WindowState state_;
    ViewerReport report_;
    bool shaders_unproven_ = false;
    bool drew_ = false;  ///< a picture, in this frame
    bool quit_ = false;
    double last_look_s_ = 0, last_frame_s_ = 0;
};

}  // namespace dermis::view
