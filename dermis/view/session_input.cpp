// Mouse and keys.

#include <algorithm>
#include <filesystem>

#include "dermis/base/text.h"
#include "dermis/render/shared_passes.h"
#include "dermis/view/orbit.h"
#include "dermis/view/session.h"

namespace dermis::view {
namespace {

constexpr double kSleepS = 0.25, kShortSleepS = 0.1;

}  // namespace

// At most one change of a button a frame: the interface would miss a click that comes and goes within one.
std::vector<Event> Session::gather_events() {
    const bool busy = awake_frames_ > 0 || loading_.valid() || !options_->script.empty() || !is_drawn() ||
                      options_->frames > 0 || !waiting_.empty();
    // A ground truth in the making wants the processor for itself.
    const double sleep_s = making_truth_.valid() ? kShortSleepS : kSleepS;
    awake_frames_ = std::max(awake_frames_ - 1, 0);
    for (Event& event : window_.poll(busy ? 0 : sleep_s)) waiting_.push_back(std::move(event));
    if (!options_->script.empty()) {
        waiting_.clear();  // the script alone
        if (!scripted_.empty()) {
            for (Event& event : scripted_.front()) waiting_.push_back(std::move(event));
            scripted_.pop_front();
        }
    }
    if (!waiting_.empty()) awake_frames_ = kAwakeFrames;
    std::vector<Event> events;
    while (!waiting_.empty()) {
        events.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
        if (events.back().kind == EventKind::mouse_button) break;
    }
    return events;
}

void Session::take_input(const std::vector<Event>& events) {
    for (const Event& event : events) {
        switch (event.kind) {
            case EventKind::key:
                if (event.pressed && !interface_->wants_keyboard())
                    act(action_of({event.key, event.modifiers}));
                break;
            case EventKind::drop:
                for (const std::filesystem::path& path : event.paths) open_file(path.string());
                break;
            case EventKind::text:
                break;
            default:
                take_mouse(event);
        }
    }
}

void Session::take_mouse(const Event& event) {
    if (event.kind == EventKind::scroll) {
        if (model_.scene && !interface_->wants_mouse())
            zoom(model_.scene->camera, event.scroll, model_.scene->bounds_radius_mm);
        return;
    }
    if (event.kind == EventKind::mouse_move) return drag_to(event.position_px);
    if (!event.pressed) {
        drag_to(event.position_px);
        drag_ = Drag::none;
        return;
    }
    mouse_px_ = event.position_px;
    if (interface_->wants_mouse()) return;
    const Region area = picture_area();
    const float line_px = area.x + model_.split * area.width;
    if (model_.compare == Compare::wipe && std::abs(mouse_px_.x - line_px) < 8 * interface_->scale()) {
        drag_ = Drag::wipe;
        return;
    }
    const bool right = event.button == MouseButton::right, middle = event.button == MouseButton::middle;
    drag_ = right || event.modifiers.ctrl     ? Drag::light
            : middle || event.modifiers.shift ? Drag::pan
                                              : Drag::orbit;
}

void Session::drag_to(Vec2 position_px) {
    const Vec2 moved_px = position_px - mouse_px_;
    mouse_px_ = position_px;
    if (!model_.scene || moved_px == Vec2{}) return;
    const Region area = picture_area();
    const float height_px = area.height;
    if (drag_ == Drag::wipe) model_.split = std::clamp((position_px.x - area.x) / area.width, 0.0f, 1.0f);
    if (drag_ == Drag::orbit) orbit(model_.scene->camera, moved_px, height_px);
    if (drag_ == Drag::pan) pan(model_.scene->camera, moved_px, height_px);
    if (drag_ == Drag::light) turn_key_light(*model_.scene, moved_px, height_px);
}

void Session::choose_technique(int step) {
    std::vector<std::string> ids;
    for (const Technique& technique : model_.catalog.techniques) ids.push_back(technique.id);
    const Result<const Technique*> next =
        find_technique(model_.catalog.techniques, neighbour(ids, model_.choices[0].technique().id, step));
    if (next) model_.choices[0].choose(**next);
    choose_view(0);
}

// With step 0: back to the final picture where the technique lacks the view.
void Session::choose_view(int step) {
    const std::vector<std::string> views = view_names(model_.choices[0].technique());
    model_.view = neighbour(views, model_.view, step);
}

// The first free of dermis-001.png, dermis-002.png, ... in the directory the program runs in.
void Session::save_picture() {
    if (!stage_) return;
    const std::string path = free_name("dermis", ".png");
    const Result<void> written = stage_->write(model_, 0, picture_size(), path);
    if (written)
        model_.notices.inform("file", "written: " + std::filesystem::absolute(path).string(), now_s());
    else
        model_.notices.complain("file", written.error().message);
}

void Session::act(Action action) {
    Scene* scene = model_.scene;
    switch (action) {
        case Action::none:
            return;
        case Action::help:
            model_.show_help = !model_.show_help;
            return;
        case Action::panels:
            model_.show_panels = !model_.show_panels;
            return;
        case Action::fit:
            if (scene) fit(scene->camera, *scene, float(picture_size().width) / float(picture_size().height));
            return;
        case Action::next_technique:
            return choose_technique(1);
        case Action::last_technique:
            return choose_technique(-1);
        case Action::next_view:
            return choose_view(1);
        case Action::last_view:
            return choose_view(-1);
        case Action::final_view:
            model_.view = "final";
            return;
        case Action::reset_parameters:
            model_.choices[0].values() = ParameterValues(model_.choices[0].technique().parameters);
            return;
        case Action::brighter:
        case Action::darker:
            if (scene) scene->exposure_ev += (action == Action::brighter ? 1.0f : -1.0f) / 3;
            return;
        case Action::compare:
            model_.compare = Compare((int(model_.compare) + 1) % 3);
            return;
        case Action::swap_sides:
            if (!truth_) std::swap(model_.choices[0], model_.choices[1]);
            return;
        case Action::ground_truth:
            return ask_for_truth();
        case Action::copy_view:
            return copy_view();
        case Action::paste_view:
            return paste_view();
        case Action::save_scene: {
            const std::string path = free_name(scene ? scene->name : "scene", ".toml");
            const Result<void> saved = save_scene(path);
            if (saved)
                model_.notices.inform("file", "written: " + std::filesystem::absolute(path).string(),
                                      now_s());
            else
                model_.notices.complain("file", saved.error().message);
            return;
        }
        case Action::screenshot:
            return save_picture();
        case Action::vsync:
            model_.vsync = !model_.vsync;
            swapchain_.reset();
            model_.notices.inform(
                "vsync", model_.vsync ? "waits for the display" : "does not wait for the display", now_s());
            return;
        case Action::dismiss:
            return model_.notices.dismiss();
        case Action::larger_interface:
        case Action::smaller_interface:
            model_.user_scale = std::clamp(
                model_.user_scale * (action == Action::larger_interface ? 1.125f : 1 / 1.125f), 0.5f, 3.0f);
            return;
        case Action::quit:
            quit_ = true;
            return;
    }
}

}  // namespace dermis::view
