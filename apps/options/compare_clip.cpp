#include "compare_clip.h"

#include <fmt/core.h>

#include "catalog/catalog.h"
#include "dermis/base/text.h"
#include "dermis/render/move_scene.h"
#include "dermis/scene/pose_scene.h"

namespace dermis::cli {
Result<std::vector<double>> clip_times(const CompareChoice& choice, const Scene& scene) {
    const double start_s = scene.motion.time_s;
    std::vector<double> times;
    if (choice.fps > 0) {
        for (int i = 0; i < choice.frames; ++i) times.push_back(start_s + i / choice.fps);
        return times;
    }
    const double length_s = clip_length_s(scene);
    if (start_s >= length_s)
        return Error{"--time " + to_text(start_s) + ": the clip ends at " + to_text(length_s) +
                     " s; start earlier, or give --fps"};
    const double part_s = (length_s - start_s) / choice.frames;
    for (int i = 0; i < choice.frames; ++i) times.push_back(start_s + (i + 0.5) * part_s);
    return times;
}

Result<IndexRange> clip_range(const std::string& frame_range, int count) {
    if (frame_range.empty()) return IndexRange{0, count};
    DERMIS_TRY_ASSIGN(const IndexRange range, parse_index_range("--frame-range", frame_range));
    if (range.begin < range.end && range.end <= count) return range;
    return Error{"--frame-range " + frame_range + ": not a range of the " + std::to_string(count) +
                 " frames (--frames); write BEGIN:END, such as 0:1"};
}

Result<ClipFrames> ClipFrames::load(const CompareChoice& choice, gpu::Device& device) {
    ClipFrames frames;
    frames.name_ = choice.scene.name + " " + choice.scene.pose.clip;
    DERMIS_TRY_ASSIGN(const Scene start, choice.scene.load());
    DERMIS_TRY_ASSIGN(frames.times_s_, clip_times(choice, start));
    CompareChoice first = choice;
    first.scene.pose.time_s = frames.times_s_.front();
    DERMIS_TRY_ASSIGN(Scene scene, first.load_scene());
    frames.shown_ = std::make_unique<SubjectCase>(SubjectCase{.name = {}, .scene = std::move(scene)});
    DERMIS_TRY_ASSIGN(
        Renderer renderer,
        Renderer::create(device, gpu::embedded_shaders(built_in_catalog().shaders), frames.shown_->scene));
    frames.renderer_ = std::make_unique<Renderer>(std::move(renderer));
    return frames;
}

Result<void> ClipFrames::show(size_t frame) {
    const double time_s = times_s_[frame];
    if (shown_->scene.motion.time_s != time_s) DERMIS_TRY(move_scene(time_s, shown_->scene, *renderer_));
    shown_->name = fmt::format("{} {:.3f} s", name_, time_s);
    return {};
}

}  // namespace dermis::cli
