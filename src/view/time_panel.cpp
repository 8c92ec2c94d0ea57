// What a frame costs, pass by pass.

#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "dermis/view/panel_parts.h"

namespace dermis::view {
namespace {

// Half the line high, so that a column of them stays calm.
void show_bar(float share, float width, float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + height * 0.3f, bottom = at.y + height * 0.75f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x, top}, {at.x + width, bottom}, ImGui::GetColorU32(ImGuiCol_FrameBg), 2);
    list.AddRectFilled({at.x, top}, {at.x + width * std::clamp(share, 0.0f, 1.0f), bottom},
                       ImGui::GetColorU32(ImGuiCol_PlotHistogram), 2);
    ImGui::Dummy({width, height});
}

}  // namespace

void show_times(const PanelFacts& facts) {
    if (!facts.frame_history_ms.empty()) {
        const float most = *std::ranges::max_element(facts.frame_history_ms);
        char text[48];
        std::snprintf(text, sizeof text, "%.1f ms", facts.frame_ms);
        ImGui::PlotHistogram("##history", facts.frame_history_ms.data(), int(facts.frame_history_ms.size()),
                             0, text, 0, most * 1.15f, {ImGui::GetContentRegionAvail().x, 44 * facts.scale});
    }
    if (!ImGui::BeginTable("passes", 3)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.42f);
    ImGui::TableSetupColumn("bar", ImGuiTableColumnFlags_WidthStretch, 0.24f);
    ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthStretch, 0.34f);
    for (const TimedPass& pass : facts.passes) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", pass.name.c_str());
        ImGui::TableNextColumn();
        const float share = facts.frame_ms > 0 ? float(pass.time_ms / facts.frame_ms) : 0;
        show_bar(share, ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight());
        ImGui::TableNextColumn();
        char text[32];
        std::snprintf(text, sizeof text, "%.2f ms", pass.time_ms);
        const float indent = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text).x;
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(indent, 0.0f));
        ImGui::TextUnformatted(text);
    }
    ImGui::EndTable();
}

}  // namespace dermis::view
