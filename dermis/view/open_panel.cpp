// The field that opens a file, over the picture.

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "dermis/view/panel_parts.h"
#include "dermis/view/path_completion.h"
#include "dermis/view/widgets.h"

namespace dermis::view {
namespace {

constexpr size_t kShownPaths = 14, kMostPathBytes = 1024;

// Tab: as far as all paths agree. A field that gets the keyboard has its cursor at the end, with nothing
// selected.
int edit_field(ImGuiInputTextCallbackData* data) {
    if (data->EventFlag == ImGuiInputTextFlags_CallbackAlways) {
        bool& is_untouched = *static_cast<bool*>(data->UserData);
        if (!std::exchange(is_untouched, false)) return 0;
        data->CursorPos = data->BufTextLen;
        data->ClearSelection();
        return 0;
    }
    const std::string longer = common_start(complete_path({data->Buf, size_t(data->BufTextLen)}));
    if (longer.empty()) return 0;
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, longer.c_str());
    return 0;
}

bool is_folder(const std::string& path) {
    return path.ends_with('/');
}

// Opens a file, enters a folder.
void choose_path(Model& model, const std::string& path, PanelRequests& requests) {
    if (is_folder(path)) {
        model.open_field = OpenField{.text = path};
        return;
    }
    requests.open = path;
    model.open_field.reset();
}

void show_paths(Model& model, const std::vector<std::string>& paths, PanelRequests& requests) {
    const size_t rows = std::clamp<size_t>(paths.size(), 1, kShownPaths);
    ImGui::BeginChild("paths", {0, float(rows) * ImGui::GetTextLineHeightWithSpacing()});
    for (const std::string& path : paths) {
        const size_t slash = path.find_last_of('/', path.size() - 2);
        const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
        if (ImGui::Selectable(name.c_str())) choose_path(model, path, requests);
    }
    if (paths.empty()) ImGui::TextDisabled("no scene, mesh or picture here");
    ImGui::EndChild();
}

}  // namespace

void show_open_field(Model& model, const PanelFacts& facts, PanelRequests& requests) {
    if (!model.open_field) return;
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    ImGui::SetNextWindowPos({picture.width / 2, picture.height * 0.12f}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({std::min(picture.width * 0.9f, ImGui::GetFontSize() * 40), 0});
    ImGui::SetNextWindowBgAlpha(0.97f);
    ImGui::Begin("open", nullptr, fixed_window() | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::TextDisabled("Open a scene, mesh or picture; tab completes");
    OpenField& field = *model.open_field;
    if (std::exchange(field.is_fresh, false)) ImGui::SetKeyboardFocusHere();
    char text[kMostPathBytes];
    std::snprintf(text, sizeof text, "%s", field.text.c_str());
    ImGui::SetNextItemWidth(-1);
    const bool entered =
        ImGui::InputText("##path", text, sizeof text,
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion |
                             ImGuiInputTextFlags_CallbackAlways,
                         edit_field, &field.is_untouched);
    const bool left = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if (!left) field.text = text;
    const std::vector<std::string> paths = complete_path(field.text);
    show_paths(model, paths, requests);
    if (entered && model.open_field && !model.open_field->text.empty())
        choose_path(model, paths.size() == 1 ? paths[0] : std::string(model.open_field->text), requests);
    if (left) model.open_field.reset();
    ImGui::End();
}

}  // namespace dermis::view
