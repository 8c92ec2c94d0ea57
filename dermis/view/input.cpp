#include "dermis/view/input.h"

#include <algorithm>
#include <cmath>

#include "dermis/view/orbit.h"

namespace dermis::view {

std::vector<Event> Input::gather(Window& window, double sleep_s) {
    awake_frames_ = std::max(awake_frames_ - 1, 0);
    for (Event& event : window.poll(sleep_s)) waiting_.push_back(std::move(event));
    if (scripted_) {
        waiting_.clear();
        if (!played_.empty()) {
            for (Event& event : played_.front()) waiting_.push_back(std::move(event));
            played_.pop_front();
        }
    }
    if (!waiting_.empty()) wake();
    std::vector<Event> events;
    while (!waiting_.empty()) {
        events.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
        if (events.back().kind == EventKind::mouse_button) break;
    }
    return events;
}

void Input::put_back(const std::vector<Event>& events) {
    waiting_.insert(waiting_.begin(), events.begin(), events.end());
}

void Input::take_mouse(const Event& event, Model& model, const Region& area, float scale, bool over_panel) {
    if (event.kind == EventKind::scroll) {
        if (model.scene && !over_panel)
            zoom(model.scene->camera, event.scroll, model.scene->bounds_radius_mm);
        return;
    }
    if (event.kind == EventKind::mouse_move) return drag_to(event.position_px, model, area);
    if (!event.pressed) {
        drag_to(event.position_px, model, area);
        drag_ = Drag::none;
        return;
    }
    mouse_px_ = event.position_px;
    if (!over_panel) press(event, model, area, scale);
}

void Input::press(const Event& event, const Model& model, const Region& area, float scale) {
    const float line_px = area.x + model.split * area.width;
    if (model.compare == Compare::wipe && std::abs(mouse_px_.x - line_px) < 8 * scale) {
        drag_ = Drag::wipe;
        return;
    }
    const bool right = event.button == MouseButton::right, middle = event.button == MouseButton::middle;
    drag_ = right || event.modifiers.ctrl     ? Drag::light
            : middle || event.modifiers.shift ? Drag::pan
                                              : Drag::orbit;
}

void Input::drag_to(Vec2 position_px, Model& model, const Region& area) {
    const Vec2 moved_px = position_px - mouse_px_;
    mouse_px_ = position_px;
    if (!model.scene || moved_px == Vec2{}) return;
    if (drag_ == Drag::wipe) model.split = std::clamp((position_px.x - area.x) / area.width, 0.0f, 1.0f);
    if (drag_ == Drag::orbit) orbit(model.scene->camera, moved_px, area.height);
    if (drag_ == Drag::pan) pan(model.scene->camera, moved_px, area.height);
    if (drag_ == Drag::light) turn_key_light(*model.scene, moved_px, area.height);
}

}  // namespace dermis::view
