// The time of each pass, of the last frame and the frames before.

#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "dermis/view/panel_parts.h"

namespace dermis::view {
namespace {

constexpr size_t kFrames = 90;  // the whole history

std::string time_text(double time_ms) {
    char text[32];
    std::snprintf(text, sizeof text, time_ms < 99.95 ? "%.2f ms" : "%.0f ms", time_ms);
    return text;
}

float median(std::vector<float> values) {
    std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
    return values[values.size() / 2];
}

// One bar per frame, the newest on the right; its height is its share of `most_ms`.
void show_history(const std::vector<float>& history_ms, float most_ms, ImVec2 size) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg), 2);
    const float step = size.x / float(kFrames);
    float right = at.x + size.x;
    for (size_t i = history_ms.size(); i-- > 0 && right > at.x; right -= step) {
        const float share = most_ms > 0 ? std::clamp(history_ms[i] / most_ms, 0.0f, 1.0f) : 0;
        list.AddRectFilled({right - step, at.y + size.y * (1 - share)}, {right, at.y + size.y},
                           ImGui::GetColorU32(ImGuiCol_PlotHistogram));
    }
    ImGui::Dummy(size);
    if (history_ms.empty() || !ImGui::IsItemHovered()) return;
    const auto [least, most] = std::ranges::minmax(history_ms);
    ImGui::SetTooltip("of the last %d pictures\nminimum %s\nmedian %s\nmaximum %s", int(history_ms.size()),
                      time_text(least).c_str(), time_text(median(history_ms)).c_str(),
                      time_text(most).c_str());
}

void right_aligned(const std::string& text) {
    const float indent = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(indent, 0.0f));
    ImGui::TextUnformatted(text.c_str());
}

}  // namespace

void show_times(const PanelFacts& facts) {
    if (facts.frame_history_ms.empty()) return;
    const float most_ms = std::ranges::max(facts.frame_history_ms);
    ImGui::TextDisabled("GPU time of a picture");
    ImGui::SameLine();
    right_aligned(time_text(facts.frame_ms));
    show_history(facts.frame_history_ms, most_ms * 1.1f,
                 {ImGui::GetContentRegionAvail().x, 44 * facts.scale});
    if (!ImGui::BeginTable("passes", 3)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.45f);
    ImGui::TableSetupColumn("history", ImGuiTableColumnFlags_WidthStretch, 0.27f);
    ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthStretch, 0.28f);
    for (const TimedPass& pass : facts.passes) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", pass.name.c_str());
        ImGui::TableNextColumn();
        show_history(pass.history_ms, std::ranges::max(pass.history_ms) * 1.1f,
                     {ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight()});
        ImGui::TableNextColumn();
        right_aligned(time_text(pass.time_ms));
    }
    ImGui::EndTable();
}

}  // namespace dermis::view
