// Warnings, each with a button that takes it away.

#include <imgui.h>

#include <algorithm>
#include <optional>

#include "dermis/base/text.h"
#include "dermis/view/panel_parts.h"
#include "dermis/view/widgets.h"

namespace dermis::view {

void show_warnings(Warnings& warnings, WidgetMap& widgets) {
    const std::vector<std::string>& unread = warnings.unread();
    const ImGuiStyle& style = ImGui::GetStyle();
    const float text_x = ImGui::CalcTextSize("read").x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    const float wrap = ImGui::GetContentRegionAvail().x - text_x - style.ScrollbarSize;
    float height = 0;
    for (const std::string& text : unread)
        height += ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap).y + style.ItemSpacing.y;
    // Twelve lines; the rest scrolls.
    ImGui::BeginChild("warnings", {0, std::min(height, 12 * ImGui::GetTextLineHeight())});
    std::optional<size_t> read;
    for (size_t i = 0; i < unread.size(); ++i) {
        ImGui::PushID(int(i));
        if (ImGui::SmallButton("read")) read = i;
        name_widget(widgets, "warning." + std::to_string(i + 1));
        ImGui::SameLine(text_x);
        ImGui::PushTextWrapPos(text_x + wrap);
        ImGui::TextUnformatted(printable_line(unread[i]).c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopID();
    }
    ImGui::EndChild();
    if (read) warnings.read(*read);
    if (unread.size() < 2) return;
    if (ImGui::SmallButton("read all")) warnings.read_all();
    name_widget(widgets, "warning.all");
}

}  // namespace dermis::view
