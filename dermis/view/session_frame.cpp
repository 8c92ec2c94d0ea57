// One frame: events in, pictures and interface out.

#include <algorithm>
#include <cmath>
#include <thread>

#include "dermis/view/perform.h"
#include "dermis/view/script_commands.h"
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

std::string probe_line(Parts& p) {
    const Region area = p.picture_area();
    const Vec2 mouse_px = p.input.mouse_px();
    const bool inside = mouse_px.x >= area.x && mouse_px.x < area.x + area.width && mouse_px.y >= area.y &&
                        mouse_px.y < area.y + area.height;
    if (!p.model.scene || !inside || p.input.drags()) return "";
    Vec2 place = {(mouse_px.x - area.x) / area.width, (mouse_px.y - area.y) / area.height};
    if (p.model.compare == Compare::side_by_side) place.x = std::fmod(place.x * 2, 1.0f);
    return p.pictures.scene().probe(place, p.picture_size());
}

PanelFacts panel_facts(Parts& p) {
    PanelFacts facts = {
        .scale = p.interface->scale(),
        .width = p.presenter->size().width,
        .height = p.presenter->size().height,
        .device = p.device.info().name,
        .picture_state = p.device.info().name,
        .loading = p.opener.is_loading() ? p.opener.loaded_path() : "",
        .elapsed_s = p.clock.elapsed_s(),
        .lacks_bakes = p.pictures.scene().is_there() && p.pictures.scene().stage().lacks_bakes(),
        .probe = probe_line(p)};
    p.pictures.describe(facts);
    return facts;
}

// Nothing to draw before the scene has come: the processor is left to its loading.
bool only_loads(const Parts& p) {
    return p.opener.is_loading() && !p.input.is_awake() && !p.input.is_playing() && !p.input.has_waiting() &&
           !p.model.playing && (!p.pictures.scene().is_there() || p.has_final_pictures());
}

std::vector<Event> gather_events(Parts& p) {
    if (only_loads(p)) return p.input.gather(p.window, kShortSleepS);
    const bool busy = p.input.is_awake() || p.opener.is_loading() || p.player.has_script() ||
                      !p.has_final_pictures() || p.options.frames > 0 || p.input.has_waiting();
    return p.input.gather(p.window, busy ? 0 : p.is_working() ? kShortSleepS : kSleepS);
}

// No event and no work in progress: a new frame would be the same as the last.
bool is_idle(const Parts& p, const std::vector<Event>& events) {
    return events.empty() && !p.input.is_awake() && p.window.framebuffer() == p.presenter->size() &&
           !p.player.has_script() && p.options.frames == 0 && p.model.notices.all().empty() && p.is_settled();
}

void take_input(Parts& p, const std::vector<Event>& events) {
    for (const Event& event : events) {
        switch (event.kind) {
            case EventKind::key:
                if (event.pressed && !p.interface->wants_keyboard())
                    perform(p, action_of({event.key, event.modifiers}));
                break;
            case EventKind::drop:
                for (const std::filesystem::path& path : event.paths) p.opener.open(path.string());
                break;
            case EventKind::text:
                break;
            default:
                p.input.take_mouse(event, p.model, p.picture_area(), p.interface->scale(),
                                   p.interface->wants_mouse());
        }
    }
}

}  // namespace

Result<void> Session::frame() {
    Parts& p = *parts_;
    const std::vector<Event> events = gather_events(p);
    if (!p.interface->holds_widget() && !p.input.drags()) p.history.follow(p.model);
    if (Result<void> taken = take_scene(); !taken) return taken;
    step_motion();
    if (p.opener.follow_files()) p.input.wake();
    if (p.reference.take(p.model, p.clock.now_s())) p.input.wake();
    p.pictures.take_times(p.model.notices);
    if (is_idle(p, events)) return {};
    const WindowSize size = p.window.framebuffer();
    if (size.width == 0 || size.height == 0) {  // minimised
        p.input.put_back(events);               // so that a key released meanwhile does not count as held
        p.pictures.skip_refresh();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return step_script();
    }
    if (Result<void> resized = p.presenter->resize(size); !resized) return resized;
    InterfaceDraws draws;
    const Result<PanelRequests> requests = show_interface(events, draws);
    if (!requests) return requests.error();
    for (const Action action : requests->actions) perform(p, action);
    if (requests->tone) p.pictures.scene().choose_tone(*requests->tone, p.model);
    if (requests->pigments) p.pictures.scene().choose_pigments(*requests->pigments, p.model);
    if (!requests->open.empty()) p.opener.open(requests->open);
    if (!p.interface->holds_widget()) p.opener.follow_words();
    if (Result<void> shown = show_pictures(draws); !shown) return shown;
    return step_script();
}

Result<void> Session::take_scene() {
    Parts& p = *parts_;
    const std::string before = p.model.scene ? p.model.scene_path : "";
    DERMIS_TRY_ASSIGN(const bool taken, p.opener.take());
    if (!taken) return {};
    p.input.wake();
    if (p.model.scene_path == before)
        p.history.amend(p.model);
    else
        p.history.forget();
    remember(state_, p.model.scene_path);
    p.model.recent = state_.recent;
    p.window.set_title(p.model.scene->name + " - Dermis");
    return {};
}

void Session::step_motion() {
    Parts& p = *parts_;
    const double now_s = p.clock.now_s();
    advance_motion(p.model, now_s - std::exchange(last_step_s_, now_s));
    if (p.model.playing) p.input.wake();
    if (p.resting_pose.is_to_be_loaded(p.model, p.pictures.scene(), now_s) && !p.opener.is_loading() &&
        !p.opener.has_new_words())
        p.opener.load_pose(), p.resting_pose.asked(p.pictures.scene());
}

Result<PanelRequests> Session::show_interface(const std::vector<Event>& events, InterfaceDraws& draws) {
    Parts& p = *parts_;
    const WindowSize size = p.presenter->size();
    const float scale = p.options.interface_scale > 0
                            ? p.options.interface_scale
                            : automatic_scale(p.window.content_scale(), size.height);
    if (Result<void> scaled = p.interface->set_scale(std::clamp(scale * p.model.user_scale, 0.5f, 6.0f));
        !scaled)
        return scaled.error();
    const double now_s = p.clock.now_s();
    p.model.notices.expire(now_s);
    p.interface->begin(events, size.width, size.height, std::max(now_s - last_frame_s_, 1e-3));
    last_frame_s_ = now_s;
    take_input(p, events);
    PanelRequests requests;
    p.widgets.clear();
    show_panels(p.model, panel_facts(p), requests, p.widgets);
    DERMIS_TRY_ASSIGN(InterfaceDraws made, p.interface->end());
    draws = std::move(made);
    return requests;
}

Result<void> Session::show_pictures(const InterfaceDraws& draws) {
    Parts& p = *parts_;
    if (Result<void> made = p.reference.refresh(p.device, p.model); !made) return made;
    p.pictures.refresh(p.model, p.reference.texture(), p.picture_size(), p.clock.now_s());
    const size_t warnings = p.model.warnings.unread().size();
    if (p.pictures.scene().is_there()) p.pictures.scene().stage().add_warnings(p.model.warnings);
    if (p.model.warnings.unread().size() > warnings) p.input.wake();  // the panel shows them
    const ShownPictures pictures = p.pictures.shown(p.model, p.reference.texture());
    DERMIS_TRY_ASSIGN(const bool shown, p.presenter->show(draws, pictures, p.model, p.interface->scale()));
    if (!shown || !pictures.a || report_.first_picture_s) return {};
    const Result<void> done = p.device.finish();
    report_.first_picture_s = p.clock.elapsed_s();
    return done;
}

Result<void> Session::step_script() {
    Parts& p = *parts_;
    if (p.input.is_playing() || p.opener.is_loading() || p.opener.has_new_words() ||
        !p.pictures.scene().is_there())
        return {};
    const ScriptCommand* command = p.player.next(p.is_settled());
    if (!command) {
        // A script that nobody watches would wait for a hand for ever.
        p.quit = p.quit || (p.options.frames == 0 && p.player.is_over(p.is_settled()));
        return {};
    }
    const Result<void> done = run_command(p, *command);
    return done ? done : p.player.error_at(*command, done.error());
}

}  // namespace dermis::view
