// Clip, time and morph targets of a mesh that moves.

#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "dermis/base/text.h"
#include "dermis/view/motion.h"
#include "dermis/view/panel_parts.h"
#include "dermis/view/widgets.h"

namespace dermis::view {
namespace {

void show_clips(Model& model, PanelRequests& requests, WidgetMap& widgets) {
    Scene& scene = *model.scene;
    const std::vector<ClipInfo> clips = clips_of(scene);
    if (clips.empty()) return;
    MotionDescription& motion = scene.motion;
    Rows rows(widgets, "motion.");
    std::vector<std::string> names = {"none"};
    for (const ClipInfo& clip : clips) names.push_back(clip.name);
    int index = motion.clip.empty() ? 0 : index_of(names, motion.clip);
    if (rows.choice({.name = "clip", .doc = "animation of the mesh file"}, names, index)) {
        motion.clip = index == 0 ? "" : names[size_t(index)];
        motion.time_s = 0;
        model.playing &= index != 0;
    }
    if (ImGui::Button(model.playing ? "Pause  (space)" : "Play  (space)"))
        requests.actions.push_back(Action::play);
    auto time_s = float(motion.time_s);
    const double length_s = clip_length_s(scene);
    if (length_s > 0 &&
        rows.number({.name = "time", .unit = "s", .doc = "in the clip", .max = length_s}, time_s))
        motion.time_s = time_s;
    const float speed_before = motion.speed;
    if (rows.number({.name = "speed",
                     .doc = "seconds of the clip in one second",
                     .min = 0.05,
                     .max = 4,
                     .default_value = 1},
                    motion.speed))
        motion.time_s *= double(speed_before) / double(motion.speed);  // the pose stays
    rows.toggle({.name = "loop", .doc = "begin again at the end of the clip"}, motion.loop);
}

void show_targets(Model& model, const std::vector<std::string>& targets, WidgetMap& widgets) {
    MotionDescription& motion = model.scene->motion;
    Rows rows(widgets, "morph.");
    const std::string wanted = to_lower(model.target_filter);
    for (const std::string& target : targets) {
        if (to_lower(target).find(wanted) == std::string::npos) continue;
        const auto stated = motion.morph.find(target);
        float weight = stated == motion.morph.end() ? 0 : stated->second;
        if (!rows.number(
                {.name = target, .doc = target + ": weight of the morph target; at 0 the clip's applies"},
                weight))
            continue;
        if (weight == 0)
            motion.morph.erase(target);
        else
            motion.morph[target] = weight;
    }
}

}  // namespace

void show_motion(Model& model, PanelRequests& requests, WidgetMap& widgets) {
    show_clips(model, requests, widgets);
    const std::vector<std::string> targets = targets_of(*model.scene);
    if (targets.empty()) return;
    char filter[64];
    std::snprintf(filter, sizeof filter, "%s", model.target_filter.c_str());
    const float reset_width = ImGui::CalcTextSize("Reset").x + 4 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - reset_width);
    if (ImGui::InputTextWithHint("##filter", "filter of morph targets", filter, sizeof filter))
        model.target_filter = filter;
    ImGui::SameLine();
    if (ImGui::Button("Reset")) model.scene->motion.morph.clear();
    // Eight rows; the rest scrolls.
    const float rows = float(std::min<size_t>(targets.size(), 8));
    ImGui::BeginChild("targets", {0, rows * ImGui::GetFrameHeightWithSpacing()});
    show_targets(model, targets, widgets);
    ImGui::EndChild();
}

}  // namespace dermis::view
