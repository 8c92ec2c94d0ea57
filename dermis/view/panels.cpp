#include "dermis/view/panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "dermis/view/head_words.h"
#include "dermis/view/motion.h"
#include "dermis/view/panel_parts.h"
#include "dermis/view/widgets.h"

namespace dermis::view {
namespace {

constexpr float kColumnWidth = 330, kStatusHeight = 26;

// Buttons beside the scene's name: open, and a list of recent scenes.
void show_files(const Model& model, PanelRequests& requests) {
    const float padding = 2 * ImGui::GetStyle().FramePadding.x;
    const bool has_recent = model.recent.size() > 1;
    const float recent_width = ImGui::CalcTextSize("recent").x + padding + ImGui::GetStyle().ItemSpacing.x;
    const float width = ImGui::CalcTextSize("open").x + padding + (has_recent ? recent_width : 0);
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
    if (ImGui::SmallButton("open")) requests.actions.push_back(Action::open);
    if (!has_recent) return;
    ImGui::SameLine();
    if (ImGui::SmallButton("recent")) ImGui::OpenPopup("recent scenes");
    if (!ImGui::BeginPopup("recent scenes")) return;
    for (const std::string& path : model.recent)
        if (ImGui::Selectable(path.c_str())) requests.open = path;
    ImGui::EndPopup();
}

void show_column(Model& model, const PanelFacts& facts, PanelRequests& requests, WidgetMap& widgets) {
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    ImGui::SetNextWindowPos({picture.x + picture.width, 0});
    ImGui::SetNextWindowSize({float(facts.width) - picture.width, float(facts.height)});
    ImGui::Begin("settings", nullptr, fixed_window() & ~ImGuiWindowFlags_NoScrollbar);
    if (model.scene) {
        ImGui::TextUnformatted(model.scene->name.c_str());
        show_files(model, requests);
        ImGui::PushTextWrapPos(0);
        if (!model.scene->credit.empty()) ImGui::TextDisabled("%s", model.scene->credit.c_str());
        ImGui::PopTextWrapPos();
    }
    if (!model.warnings.unread().empty() && section("Warnings", true, widgets))
        show_warnings(model.warnings, widgets);
    if (model.scene && !materials_of(*model.scene).empty() &&
        section("Head", has_guessed_classes(*model.scene), widgets))
        show_head(model, widgets);
    if (model.scene && has_motion(*model.scene) && section("Motion", true, widgets))
        show_motion(model, requests, widgets);
    if (section("Technique", true, widgets)) show_technique(model, 0, requests, widgets);
    if (section("Picture", true, widgets)) show_view(model, widgets);
    if (model.scene && section("Skin", false, widgets)) show_skin(model, requests, widgets);
    if (section("Compare", true, widgets)) show_compare(model, requests, widgets);
    if (model.scene && section("Light", true, widgets)) show_light(*model.scene, widgets);
    if (model.scene && section("Camera", false, widgets)) show_camera(*model.scene, requests, widgets);
    if (section("Time", true, widgets)) show_times(facts);
    ImGui::End();
}

void show_status(const Model& model, const PanelFacts& facts) {
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    ImGui::SetNextWindowPos({0, picture.height});
    ImGui::SetNextWindowSize({picture.width, float(facts.height) - picture.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(12 * facts.scale, 4 * facts.scale));
    ImGui::Begin("status", nullptr, fixed_window() | ImGuiWindowFlags_NoInputs);
    if (facts.probe.empty())
        ImGui::TextDisabled("%s   %s", facts.picture_state.c_str(), facts.loading.empty() ? "" : "loading …");
    else
        ImGui::TextUnformatted(facts.probe.c_str());
    const char* right = "F1 help";
    const float taken = ImGui::GetItemRectMax().x;
    if (taken + ImGui::CalcTextSize(right).x + 24 * facts.scale < picture.width) {
        ImGui::SameLine(picture.width - ImGui::CalcTextSize(right).x - 12 * facts.scale);
        ImGui::TextDisabled("%s", right);
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace

Region picture_region(const Model& model, int width, int height, float scale) {
    if (!model.show_panels) return {0, 0, float(width), float(height)};
    const float column = std::min(std::round(kColumnWidth * scale), float(width) * 0.5f);
    const float status = std::min(std::round(kStatusHeight * scale), float(height) * 0.25f);
    return {0, 0, float(width) - column, float(height) - status};
}

void show_panels(Model& model, const PanelFacts& facts, PanelRequests& requests, WidgetMap& widgets) {
    if (model.show_panels) {
        show_column(model, facts, requests, widgets);
        show_status(model, facts);
    }
    show_loading(model, facts);
    show_baking(facts);
    show_side_names(model, facts);
    show_notices(model, facts);
    show_open_field(model, facts, requests);
    if (model.show_help) show_help(facts);
}

}  // namespace dermis::view
