#include "compare_clip.h"

#include <fmt/core.h>

#include "dermis/base/text.h"
#include "dermis/scene/pose_scene.h"

namespace dermis::cli {
Result<std::vector<double>> clip_times(const CompareChoice& choice) {
    const double start_s = choice.scene.pose.time_s.value_or(0);
    std::vector<double> times;
    if (choice.fps > 0) {
        for (int i = 0; i < choice.frames; ++i) times.push_back(start_s + i / choice.fps);
        return times;
    }
    DERMIS_TRY_ASSIGN(const Scene scene, choice.scene.load());
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

Result<Scene> clip_view(const CompareChoice& choice, double time_s) {
    SceneChoice moment = choice.scene;
    moment.pose.time_s = time_s;
    DERMIS_TRY_ASSIGN(const Scene scene, moment.load());
    return without_objects(scene);
}

Result<SubjectCase> clip_frame(const CompareChoice& choice, double time_s, const Scene* first) {
    CompareChoice moment = choice;
    moment.scene.pose.time_s = time_s;
    DERMIS_TRY_ASSIGN(Scene scene, moment.load_scene());
    if (first) {
        scene.camera = first->camera;
        fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
        scene.lights = first->lights;
    }
    return SubjectCase{
        .name = fmt::format("{} {} {:.3f} s", choice.scene.name, choice.scene.pose.clip, time_s),
        .scene = std::move(scene)};
}

Result<void> ComparedFrames::add(const SubjectCase& one, double time_s, const Comparison& comparison) {
    all.push_back({.time_s = time_s, .rows = score_rows(one.name, comparison)});
    ClipEffects effects = clip_effects(comparison);
    if (last) DERMIS_TRY(set_motion_shares(*last, effects, all.back().rows));
    last = std::move(effects);
    return {};
}

}  // namespace dermis::cli
