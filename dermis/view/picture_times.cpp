#include "dermis/view/picture_times.h"

#include <cstdio>

namespace dermis::view {
namespace {

constexpr size_t kHistoryFrames = 90;

void add_to(std::vector<float>& history, double time_ms) {
    history.push_back(float(time_ms));
    if (history.size() > kHistoryFrames) history.erase(history.begin());
}

}  // namespace

void PictureTimes::add(const gpu::FrameResult& timings) {
    add_to(frames_ms_, timings.frame_ms);
    std::map<std::string, std::vector<float>> histories;
    for (const gpu::PassTiming& pass : timings.passes) {
        std::vector<float>& history = histories[pass.name];
        if (history.empty()) history = std::move(passes_ms_[pass.name]);
        add_to(history, pass.time_ms);
    }
    passes_ms_ = std::move(histories);
}

void PictureTimes::describe(const Picture& picture, PanelFacts& facts) const {
    const std::string samples = std::to_string(picture.quality.samples);
    char time[32];
    std::snprintf(time, sizeof time, picture.timings.frame_ms < 10 ? "%.1f ms" : "%.0f ms",
                  picture.timings.frame_ms);
    facts.picture_state = std::to_string(picture.width) + " x " + std::to_string(picture.height) + "   " +
                          samples + (samples == "1" ? " sample   " : " samples   ") + time + "   " +
                          facts.device;
    facts.frame_ms = picture.timings.frame_ms;
    facts.frame_history_ms = frames_ms_;
    for (const gpu::PassTiming& pass : picture.timings.passes)
        if (const auto history = passes_ms_.find(pass.name); history != passes_ms_.end())
            facts.passes.push_back({pass.name, pass.time_ms, history->second});
}

}  // namespace dermis::view
