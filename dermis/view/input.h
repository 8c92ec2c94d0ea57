#pragma once
// Events: from the display or from a script, one frame's worth at a time, and what the mouse does over the
// picture.

#include <deque>
#include <vector>

#include "dermis/view/model.h"
#include "dermis/view/panels.h"
#include "dermis/view/window.h"

namespace dermis::view {

class Input {
  public:
    /// `scripted`: events of the display are passed over.
    explicit Input(bool scripted) : scripted_(scripted) {}

    /// The events of one frame; sleeps until there are some, at most `sleep_s`. At most one change of a
    /// button: the interface would miss a click that comes and goes within a frame.
    [[nodiscard]] std::vector<Event> gather(Window& window, double sleep_s);
    /// They come again with the next frame.
    void put_back(const std::vector<Event>& events);
    [[nodiscard]] bool has_waiting() const { return !waiting_.empty(); }

    /// Frames of a script's input.
    void play(std::deque<std::vector<Event>> frames) { played_ = std::move(frames); }
    [[nodiscard]] bool is_playing() const { return !played_.empty(); }

    /// The interface answers an event over a few frames: until they are drawn the window is awake.
    void wake() { awake_frames_ = kAwakeFrames; }
    [[nodiscard]] bool is_awake() const { return awake_frames_ > 0; }

    /// The mouse over the picture: orbit, pan, zoom, the key light, the wipe. `area`: of the picture.
    void take_mouse(const Event& event, Model& model, const Region& area, float scale, bool over_panel);
    [[nodiscard]] Vec2 mouse_px() const { return mouse_px_; }
    [[nodiscard]] bool drags() const { return drag_ != Drag::none; }

  private:
    enum class Drag { none, orbit, pan, light, wipe };
    static constexpr int kAwakeFrames = 3;

    void press(const Event& event, const Model& model, const Region& area, float scale);
    void drag_to(Vec2 position_px, Model& model, const Region& area);

    bool scripted_;
    std::deque<Event> waiting_;  ///< not yet given to the interface
    std::deque<std::vector<Event>> played_;
    int awake_frames_ = kAwakeFrames;
    Drag drag_ = Drag::none;
    Vec2 mouse_px_;
};

}  // namespace dermis::view
