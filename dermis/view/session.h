#pragma once
// What lives while the window is open. Its work is spread over session.cpp (opening, running, losing the
// device), session_frame.cpp, session_scene.cpp, session_input.cpp, session_files.cpp, session_truth.cpp and
// session_script.cpp.

#include <atomic>
#include <chrono>
#include <deque>
#include <future>

#include "dermis/gpu/swapchain.h"
#include "dermis/judge/reference_cache.h"
#include "dermis/view/hot_shaders.h"
#include "dermis/view/interface.h"
#include "dermis/view/probe.h"
#include "dermis/view/stage.h"
#include "dermis/view/state_file.h"
#include "dermis/view/viewer.h"
#include "dermis/view/window.h"
#include "dermis/view/window_frame.h"

namespace dermis::view {

/// In every message of a lost device (dermis/gpu).
inline constexpr std::string_view kDeviceLost = "the GPU was lost";

class Session {
  public:
    [[nodiscard]] static Result<std::unique_ptr<Session>> open(const ViewerOptions& options);
    [[nodiscard]] Result<ViewerReport> run();
    /// What another session needs to go on where this one ended.
    ~Session() { stop_truth_ = true; }  // its future waits
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    void hand_over(ViewerOptions& options);
    [[nodiscard]] bool has_scene() const { return model_.scene != nullptr; }

  private:
    enum class Drag { none, orbit, pan, light, wipe };

    Session(const ViewerOptions& options, Window window, gpu::Device device);
    [[nodiscard]] Result<void> make_window_side();
    [[nodiscard]] Result<void> make_swapchain();

    [[nodiscard]] double now_s() const;

    // session_scene.cpp
    void load(const std::string& path);
    [[nodiscard]] Result<void> take_loaded();
    [[nodiscard]] Result<void> begin_scene(Start start, bool first);
    void take_over(const Handed& handed);
    void take_technique(const Scene& look);
    void follow_scene();
    /// True when something changed.
    bool follow_files();
    bool follow_scene_files();

    // session_truth.cpp
    void open_truth(const std::string& path);
    void ask_for_truth();
    [[nodiscard]] bool take_truth();
    [[nodiscard]] Result<void> refresh_truth();

    // session_files.cpp
    void open_file(const std::string& path);
    void open_panorama(const std::string& path);
    void choose_tone(int tone);
    void follow_skin();
    void copy_view();
    void paste_view();
    [[nodiscard]] Result<void> save_scene(const std::string& path);
    [[nodiscard]] std::string free_name(const std::string& stem, const std::string& extension) const;
    [[nodiscard]] std::string probe_line();

    // session_frame.cpp
    [[nodiscard]] Result<void> frame();
    [[nodiscard]] Result<void> refresh_pictures();
    void note_times(const gpu::FrameResult& timings);
    [[nodiscard]] Result<void> show(const InterfaceDraws& draws);
    [[nodiscard]] Result<void> rescale();
    [[nodiscard]] PanelFacts facts() const;
    [[nodiscard]] PictureSize picture_size() const;
    [[nodiscard]] Region picture_area() const;
    /// The pictures are as good as they get.
    [[nodiscard]] bool is_drawn() const;
    /// And nothing is on its way that would change them.
    [[nodiscard]] bool is_settled() const;
    [[nodiscard]] bool may_rest(const std::vector<Event>& events, WindowSize size) const;

    // session_input.cpp
    [[nodiscard]] std::vector<Event> gather_events();
    void take_input(const std::vector<Event>& events);
    void take_mouse(const Event& event);
    void drag_to(Vec2 position_px);
    void act(Action action);
    void choose_technique(int step);
    void choose_view(int step);
    void save_picture();

    // session_script.cpp
    [[nodiscard]] Result<void> step_script();
    [[nodiscard]] Result<void> run_command(const ScriptCommand& command);
    [[nodiscard]] Result<void> capture(const std::string& path);
    [[nodiscard]] std::string state_text();

    const ViewerOptions* options_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
    // In this order: what is below dies before what is above.
    Window window_;
    gpu::Device device_;
    std::optional<gpu::Swapchain> swapchain_;
    std::optional<gpu::Executor> executor_;
    std::optional<Interface> interface_;
    HotShaders shaders_;
    std::optional<Stage> stage_;
    std::optional<gpu::Texture> truth_;  ///< the right side, when it is a picture
    std::optional<Probe> probe_;
    Model model_;

    std::future<Result<Start>> loading_;
    std::string loading_path_;
    bool reloading_ = false;           ///< the same scene again: what was changed stays
    bool scene_file_changed_ = false;  ///< since the scene was last read, not only its meshes and maps
    FileWatch scene_files_;
    Scene file_look_;  ///< as the scene's files had it
    std::optional<Vec3> mean_albedo_;
    Vec3 drawn_tint_;  ///< what the materials on the device were made with
    bool shaders_unproven_ = false;
    Image truth_image_;
    std::atomic<bool> stop_truth_ = false;
    std::atomic<float> truth_done_ = 0;  ///< 0..1
    std::future<Result<CachedReference>> making_truth_;
    std::string truth_key_;
    std::string asked_view_;
    std::string truth_view_;  ///< hash_of_views() of the scene that it was made of; empty for a file
    double last_look_s_ = 0;
    std::string probe_text_;
    std::string probe_key_;
    WindowState state_;
    WindowSize size_;
    std::deque<Event> waiting_;  ///< not yet given to the interface
    WidgetMap widgets_;
    Drag drag_ = Drag::none;
    Vec2 mouse_px_;
    static constexpr int kAwakeFrames = 3;  // the interface answers an event over a few frames
    int awake_frames_ = kAwakeFrames;       ///< to draw before sleeping
    bool drew_ = false;                     ///< a picture, in this frame
    bool quit_ = false;
    std::vector<float> history_ms_;
    std::map<std::string, std::vector<float>> pass_history_ms_;
    double last_frame_s_ = 0;

    size_t next_command_ = 0;
    std::deque<std::vector<Event>> scripted_;
    bool settling_ = false;
    ViewerReport report_;
};

}  // namespace dermis::view
