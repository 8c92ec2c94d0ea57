// One frame: events in, pictures and interface out.

#include <algorithm>
#include <cmath>
#include <thread>

#include "dermis/view/session.h"

namespace dermis::view {
namespace {

constexpr double kSleepS = 0.25, kShortSleepS = 0.1;
constexpr float kDesignHeightPx = 900;  // the window's height at which the interface has scale 1

// In steps of a quarter: a font is made for each.
float automatic_scale(float content_scale, int height) {
    const float by_height = std::floor(float(height) / kDesignHeightPx * 4) / 4;
    return std::clamp(std::max(content_scale, by_height), 1.0f, 4.0f);
}

}  // namespace

Region Session::picture_area() const {
    const WindowSize size = presenter_->size();
    return picture_region(model_, size.width, size.height, interface_->scale());
}

PictureSize Session::picture_size() const {
    const Region area = picture_area();
    const float share = model_.compare == Compare::side_by_side ? 0.5f : 1;
    return {std::max(1, int(area.width * share)), std::max(1, int(area.height))};
}

PanelFacts Session::facts() {
    PanelFacts facts = {.scale = interface_->scale(),
                        .width = presenter_->size().width,
                        .height = presenter_->size().height,
                        .device = report_.device,
                        .picture_state = report_.device,
                        .loading = loader_.is_loading(),
                        .probe = probe_line()};
    if (shown_.is_there() && shown_.stage().picture(0).width > 0)
        times_.describe(shown_.stage().picture(0), facts);
    return facts;
}

std::string Session::probe_line() {
    const Region area = picture_area();
    const Vec2 mouse_px = input_.mouse_px();
    const bool inside = mouse_px.x >= area.x && mouse_px.x < area.x + area.width && mouse_px.y >= area.y &&
                        mouse_px.y < area.y + area.height;
    if (!model_.scene || !inside || input_.drags()) return "";
    Vec2 place = {(mouse_px.x - area.x) / area.width, (mouse_px.y - area.y) / area.height};
    if (model_.compare == Compare::side_by_side) place.x = std::fmod(place.x * 2, 1.0f);
    return shown_.probe(place, picture_size());
}

std::vector<Event> Session::gather_events() {
    const bool busy = input_.is_awake() || loader_.is_loading() || player_.has_script() || !is_drawn() ||
                      options_->frames > 0 || input_.has_waiting();
    // A ground truth in the making wants the processor for itself.
    return input_.gather(window_, busy ? 0 : truth_.is_making() ? kShortSleepS : kSleepS);
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
                input_.take_mouse(event, model_, picture_area(), interface_->scale(),
                                  interface_->wants_mouse());
        }
    }
}

Result<PanelRequests> Session::show_interface(const std::vector<Event>& events, InterfaceDraws& draws) {
    const WindowSize size = presenter_->size();
    const float scale = options_->interface_scale > 0 ? options_->interface_scale
                                                      : automatic_scale(window_.content_scale(), size.height);
    if (Result<void> scaled = interface_->set_scale(std::clamp(scale * model_.user_scale, 0.5f, 6.0f));
        !scaled)
        return scaled.error();
    model_.notices.expire(now_s());
    interface_->begin(events, size.width, size.height, std::max(now_s() - last_frame_s_, 1e-3));
    last_frame_s_ = now_s();
    take_input(events);
    PanelRequests requests;
    widgets_.clear();
    show_panels(model_, facts(), requests, widgets_);
    Result<InterfaceDraws> made = interface_->end();
    if (!made) return made.error();
    draws = std::move(*made);
    return requests;
}

Result<void> Session::refresh_pictures() {
    drew_ = false;
    if (!shown_.is_there()) return {};
    shown_.follow_skin();
    if (Result<void> made = truth_.refresh(device_, model_); !made) return made;
    const size_t sides = model_.compares() && !truth_.texture() ? 2 : 1;
    for (size_t side = 0; side < sides; ++side) {
        const Result<bool> drew = shown_.stage().refresh(model_, side, picture_size(), now_s());
        const std::string topic = "picture " + std::to_string(side);
        if (!drew) {
            // Shaders that compile and do not fit together are taken back; anything else is told.
            if (shaders_unproven_ && shaders_.take_back(drew.error().message))
                shown_.stage().forget_shaders();
            else
                model_.notices.report_error(topic, drew.error().message);
            continue;
        }
        if (!*drew) continue;
        model_.notices.clear(topic);
        if (shaders_unproven_) shaders_.confirm();
        shaders_unproven_ = false;
        drew_ = true;
        if (side == 0) times_.add(shown_.stage().picture(0).timings);
    }
    return {};
}

Result<void> Session::show(const InterfaceDraws& draws) {
    ShownPictures pictures = {.truth = truth_.texture()};
    if (shown_.is_there()) {
        pictures.a = shown_.stage().image(0);
        if (model_.compares() && !pictures.truth) pictures.b = shown_.stage().image(1);
    }
    const Result<bool> shown = presenter_->show(draws, pictures, model_, interface_->scale());
    if (!shown) return shown.error();
    if (*shown && pictures.a && report_.first_picture_s == 0)
        report_.first_picture_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    return {};
}

bool Session::is_drawn() const {
    if (!shown_.is_there() || drew_) return false;
    const Stage& stage = shown_.stage();
    return stage.is_final(0) && (!model_.compares() || truth_.texture() || stage.is_final(1));
}

bool Session::is_settled() const {
    return is_drawn() && !loader_.is_loading() && !truth_.is_making();
}

Result<void> Session::frame() {
    const std::vector<Event> events = gather_events();
    if (Result<void> taken = take_loaded(); !taken) return taken;
    if (follow_files()) input_.wake();
    if (truth_.take(model_, now_s())) input_.wake();
    const WindowSize size = window_.framebuffer();
    // Nothing has happened and nothing is on its way: the window shows what it would show again.
    if (events.empty() && !input_.is_awake() && size == presenter_->size() && !player_.has_script() &&
        options_->frames == 0 && model_.notices.all().empty() && is_settled())
        return {};
    if (size.width == 0 || size.height == 0) {  // minimised
        input_.put_back(events);                // a key let go meanwhile is not held
        drew_ = false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return step_script();
    }
    if (Result<void> resized = presenter_->resize(size); !resized) return resized;
    InterfaceDraws draws;
    const Result<PanelRequests> requests = show_interface(events, draws);
    if (!requests) return requests.error();
    for (const Action action : requests->actions) act(action);
    if (requests->tone) shown_.choose_tone(*requests->tone, model_);
    if (!requests->open.empty()) open_file(requests->open);
    if (Result<void> refreshed = refresh_pictures(); !refreshed) return refreshed;
    if (Result<void> shown = show(draws); !shown) return shown;
    return step_script();
}

}  // namespace dermis::view
