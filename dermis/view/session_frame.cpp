// One frame: events in, pictures and interface out.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "dermis/view/session.h"

namespace dermis::view {
namespace {

constexpr size_t kHistoryFrames = 90;
constexpr float kDesignHeightPx = 900;  // the window's height at which the interface has scale 1

// In steps of a quarter: a font is made for each.
float automatic_scale(float content_scale, int height) {
    const float by_height = std::floor(float(height) / kDesignHeightPx * 4) / 4;
    return std::clamp(std::max(content_scale, by_height), 1.0f, 4.0f);
}

}  // namespace

Region Session::picture_area() const {
    return picture_region(model_, size_.width, size_.height, interface_->scale());
}

PictureSize Session::picture_size() const {
    const Region area = picture_area();
    const float share = model_.compare == Compare::side_by_side ? 0.5f : 1;
    return {std::max(1, int(area.width * share)), std::max(1, int(area.height))};
}

Result<void> Session::rescale() {
    const float scale = options_->interface_scale > 0
                            ? options_->interface_scale
                            : automatic_scale(window_.content_scale(), size_.height);
    return interface_->set_scale(std::clamp(scale * model_.user_scale, 0.5f, 6.0f));
}

PanelFacts Session::facts() const {
    PanelFacts facts = {.scale = interface_->scale(),
                        .width = size_.width,
                        .height = size_.height,
                        .device = report_.device,
                        .frame_history_ms = history_ms_,
                        .loading = loading_.valid(),
                        .probe = probe_text_};
    facts.picture_state = facts.device;
    if (!stage_ || stage_->picture(0).width == 0) return facts;
    const Picture& picture = stage_->picture(0);
    const std::string samples = std::to_string(picture.quality.samples);
    char time[32];
    std::snprintf(time, sizeof time, picture.timings.frame_ms < 10 ? "%.1f ms" : "%.0f ms",
                  picture.timings.frame_ms);
    facts.picture_state = std::to_string(picture.width) + " x " + std::to_string(picture.height) + "   " +
                          samples + (samples == "1" ? " sample   " : " samples   ") + time + "   " +
                          facts.device;
    facts.frame_ms = picture.timings.frame_ms;
    for (const gpu::PassTiming& pass : picture.timings.passes)
        if (const auto history = pass_history_ms_.find(pass.name); history != pass_history_ms_.end())
            facts.passes.push_back({pass.name, pass.time_ms, history->second});
    return facts;
}

// Passes that this picture did not have are forgotten.
void Session::note_times(const gpu::FrameResult& timings) {
    const auto add = [](std::vector<float>& history, double time_ms) {
        history.push_back(float(time_ms));
        if (history.size() > kHistoryFrames) history.erase(history.begin());
    };
    add(history_ms_, timings.frame_ms);
    std::map<std::string, std::vector<float>> histories;
    for (const gpu::PassTiming& pass : timings.passes) {
        std::vector<float>& history = histories[pass.name];
        if (history.empty()) history = std::move(pass_history_ms_[pass.name]);
        add(history, pass.time_ms);
    }
    pass_history_ms_ = std::move(histories);
}

Result<void> Session::refresh_pictures() {
    drew_ = false;
    if (!stage_) return {};
    follow_skin();
    if (Result<void> made = refresh_truth(); !made) return made;
    const size_t sides = model_.compares() && !truth_ ? 2 : 1;
    for (size_t side = 0; side < sides; ++side) {
        const Result<bool> drew = stage_->refresh(model_, side, picture_size(), now_s());
        const std::string topic = "picture " + std::to_string(side);
        if (!drew) {
            // Shaders that compile and do not fit together are taken back; anything else is told.
            if (shaders_unproven_ && shaders_.take_back(drew.error().message))
                stage_->forget_shaders();
            else
                model_.notices.complain(topic, drew.error().message);
            continue;
        }
        if (!*drew) continue;
        model_.notices.clear(topic);
        if (shaders_unproven_) shaders_.confirm();
        shaders_unproven_ = false;
        drew_ = true;
        if (side > 0) continue;
        note_times(stage_->picture(0).timings);
    }
    return {};
}

Result<void> Session::show(const InterfaceDraws& draws) {
    if (!swapchain_)  // its pacing was changed
        if (Result<void> made = make_swapchain(); !made) return made;
    const auto a = stage_ ? stage_->image(0) : std::nullopt;
    const auto b = stage_ && model_.compares() && !truth_ ? stage_->image(1) : std::nullopt;
    const bool two = model_.compares() && (b || truth_);
    gpu::FrameInputs inputs = {.width = size_.width, .height = size_.height, .draws = draws.draws};
    Arrangement arrangement = Arrangement::none;
    if (a) {
        arrangement = Arrangement::one;
        if (two && model_.compare == Compare::wipe) arrangement = Arrangement::wipe;
        if (two && model_.compare == Compare::side_by_side) arrangement = Arrangement::side_by_side;
        inputs.images["picture_a"] = *a;
        if (truth_)
            inputs.textures["picture_b"] = &*truth_;
        else
            inputs.images["picture_b"] = b ? *b : *a;
    }
    const PassList list = window_passes({.width = size_.width,
                                         .height = size_.height,
                                         .region = picture_area(),
                                         .arrangement = arrangement,
                                         .split = model_.split,
                                         .line_px = std::max(1.0f, std::round(interface_->scale())),
                                         .has_interface = !draws.draws.empty()});
    if (const auto run = executor_->run(list, inputs); !run) return run.error();
    const Result<gpu::Presented> presented = swapchain_->present(*executor_, "window");
    if (!presented) return presented.error();
    if (*presented == gpu::Presented::resize) return swapchain_->resize(size_.width, size_.height);
    if (a && report_.first_picture_s == 0)
        report_.first_picture_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    return {};
}

bool Session::is_drawn() const {
    if (!stage_ || drew_) return false;
    return stage_->is_final(0) && (!model_.compares() || truth_ || stage_->is_final(1));
}

bool Session::is_settled() const {
    return is_drawn() && !loading_.valid() && !making_truth_.valid();
}

// Nothing has happened and nothing is on its way: the window shows what it would show again.
bool Session::may_rest(const std::vector<Event>& events, WindowSize size) const {
    return events.empty() && awake_frames_ == 0 && size == size_ && options_->script.empty() &&
           options_->frames == 0 && model_.notices.all().empty() && is_settled();
}

Result<void> Session::frame() {
    const std::vector<Event> events = gather_events();
    if (Result<void> taken = take_loaded(); !taken) return taken;
    if (follow_files()) awake_frames_ = kAwakeFrames;
    if (take_truth()) awake_frames_ = kAwakeFrames;
    const WindowSize size = window_.framebuffer();
    if (may_rest(events, size)) return {};
    if (size.width == 0 || size.height == 0) {  // minimised
        waiting_.insert(waiting_.begin(), events.begin(),
                        events.end());  // a key let go meanwhile is not held
        drew_ = false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return step_script();
    }
    if (size != size_) {
        size_ = size;
        if (swapchain_)
            if (Result<void> resized = swapchain_->resize(size.width, size.height); !resized) return resized;
    }
    if (Result<void> scaled = rescale(); !scaled) return scaled;
    model_.notices.expire(now_s());
    interface_->begin(events, size.width, size.height, std::max(now_s() - last_frame_s_, 1e-3));
    last_frame_s_ = now_s();
    take_input(events);
    probe_text_ = probe_line();
    PanelRequests requests;
    widgets_.clear();
    show_panels(model_, facts(), requests, widgets_);
    Result<InterfaceDraws> draws = interface_->end();
    if (!draws) return draws.error();
    for (const Action action : requests.actions) act(action);
    if (requests.tone) choose_tone(*requests.tone);
    if (!requests.open.empty()) open_file(requests.open);
    if (Result<void> refreshed = refresh_pictures(); !refreshed) return refreshed;
    if (Result<void> shown = show(*draws); !shown) return shown;
    return step_script();
}

}  // namespace dermis::view
