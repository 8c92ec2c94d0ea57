// Drawn over the picture: names of the sides, notices, help.

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/view/panel_parts.h"
#include "dermis/view/widgets.h"

namespace dermis::view {
namespace {

// A side's name, on a dark plate so that it can be read over any picture.
void show_side_name(const std::string& name, float x, float scale, bool to_the_left) {
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    const float pad = 6 * scale, left = to_the_left ? x - size.x - 2 * pad : x;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({left, pad}, {left + size.x + 2 * pad, 2 * pad + size.y + pad},
                       IM_COL32(20, 20, 20, 170), 3 * scale);
    list.AddText({left + pad, 1.5f * pad + pad * 0.5f}, IM_COL32(225, 225, 225, 255), name.c_str());
}

constexpr float kWhatColumn = 13, kHelpColumns = 40;  // widths, in heights of the font

void help_table(const char* id, std::span<const std::pair<std::string, std::string>> rows) {
    if (!ImGui::BeginTable(id, 2)) return;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * kWhatColumn);
    ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthFixed,
                            ImGui::GetFontSize() * (kHelpColumns - kWhatColumn));
    for (const auto& [what, meaning] : rows) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(what.c_str());
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", meaning.c_str());
    }
    ImGui::EndTable();
}

// As large as its content, and not for the mouse.
ImGuiWindowFlags shrunk_window() {
    return fixed_window() | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs;
}

}  // namespace

void show_loading(const Model& model, const PanelFacts& facts) {
    if (facts.loading.empty() || model.scene) return;
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    const std::string name = std::filesystem::path(facts.loading).filename().string();
    ImGui::SetNextWindowPos({picture.width / 2, picture.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("loading", nullptr, shrunk_window());
    ImGui::Text("loading %s, %.0f s", printable_line(name).c_str(), facts.elapsed_s);
    ImGui::End();
}

void show_baking(const PanelFacts& facts) {
    if (!facts.lacks_bakes) return;
    const std::string progress = current_progress();
    ImGui::SetNextWindowPos({12 * facts.scale, 12 * facts.scale}, ImGuiCond_Always);
    ImGui::Begin("baking", nullptr, shrunk_window());
    ImGui::TextUnformatted(progress.empty() ? "baking" : progress.c_str());
    ImGui::TextDisabled("once for this head; until then without scattering");
    ImGui::End();
}

void show_side_names(const Model& model, const PanelFacts& facts) {
    if (!model.compares() || !model.scene) return;
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    const std::string right = model.reference_path.empty()
                                  ? model.choices[1].technique().id
                                  : std::filesystem::path(model.reference_path).filename().string();
    const std::string stale = model.reference_is_of_another_view ? ", of another view (G: of this one)" : "";
    const float split = model.compare == Compare::wipe ? model.split : 0.5f;
    const float line = picture.x + picture.width * split, gap = 6 * facts.scale;
    show_side_name(model.choices[0].technique().id, line - gap, facts.scale, true);
    show_side_name(right + stale, line + gap, facts.scale, false);
}

void show_notices(const Model& model, const PanelFacts& facts) {
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    float bottom = picture.height - 10 * facts.scale;
    for (const Notice& notice : model.notices.all()) {
        ImGui::SetNextWindowPos({12 * facts.scale, bottom}, ImGuiCond_Always, {0, 1});
        ImGui::SetNextWindowSizeConstraints({0, 0}, {picture.width - 24 * facts.scale, picture.height});
        ImGui::SetNextWindowBgAlpha(0.9f);
        ImGui::Begin(("notice " + notice.topic).c_str(), nullptr,
                     fixed_window() | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoInputs);
        if (notice.is_error) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.96f, 0.52f, 0.45f, 1));
        ImGui::PushTextWrapPos(std::min(picture.width - 48 * facts.scale, ImGui::GetFontSize() * 52));
        ImGui::TextUnformatted(notice.text.c_str());
        ImGui::PopTextWrapPos();
        if (notice.is_error) ImGui::PopStyleColor();
        bottom -= ImGui::GetWindowHeight() + 6 * facts.scale;
        ImGui::End();
    }
}

void show_help(const PanelFacts& facts) {
    const auto width = float(facts.width), height = float(facts.height);
    ImGui::SetNextWindowPos({width / 2, height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.97f);
    ImGui::Begin("help", nullptr,
                 fixed_window() | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
    // Smaller in a small window, so that all of it is visible.
    ImGui::SetWindowFontScale(1);
    const size_t rows = gestures().size() + shortcuts().size() + 3;
    const ImVec2 margin = ImGui::GetStyle().WindowPadding;
    const float row = ImGui::GetTextLineHeightWithSpacing() + 2 * ImGui::GetStyle().CellPadding.y;
    const float fit = std::min((height - 4 * margin.y) / (float(rows) * row),
                               (width - 4 * margin.x) / (kHelpColumns * ImGui::GetFontSize()));
    ImGui::SetWindowFontScale(std::clamp(fit, 0.3f, 1.0f));
    std::vector<std::pair<std::string, std::string>> mouse, keys;
    for (const Gesture& gesture : gestures()) mouse.emplace_back(gesture.gesture, gesture.meaning);
    for (const Shortcut& shortcut : shortcuts())
        keys.emplace_back(key_chord_text(shortcut.chord), shortcut.meaning);
    ImGui::TextUnformatted("Mouse, over the picture");
    ImGui::Separator();
    help_table("mouse", mouse);
    ImGui::Spacing();
    ImGui::TextUnformatted("Keys");
    ImGui::Separator();
    help_table("keys", keys);
    ImGui::End();
}

}  // namespace dermis::view
