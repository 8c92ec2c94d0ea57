#include "dermis/view/interface_style.h"

#include <imgui.h>

namespace dermis::view {
namespace {

// Neutral greys, so that the interface does not influence the judgement of skin colours; one warm accent.
void set_colors(ImGuiStyle& style) {
    const auto grey = [](float value, float alpha = 1) { return ImVec4(value, value, value, alpha); };
    const ImVec4 accent(0.80f, 0.53f, 0.40f, 1), dim_accent(0.80f, 0.53f, 0.40f, 0.55f);
    ImGui::StyleColorsDark(&style);
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_Text] = grey(0.88f);
    colors[ImGuiCol_TextDisabled] = grey(0.56f);
    colors[ImGuiCol_WindowBg] = grey(0.115f);
    colors[ImGuiCol_PopupBg] = grey(0.15f, 0.98f);
    colors[ImGuiCol_Border] = grey(0.24f);
    colors[ImGuiCol_FrameBg] = grey(0.19f);
    colors[ImGuiCol_FrameBgHovered] = grey(0.24f);
    colors[ImGuiCol_FrameBgActive] = grey(0.27f);
    colors[ImGuiCol_Button] = grey(0.21f);
    colors[ImGuiCol_ButtonHovered] = grey(0.28f);
    colors[ImGuiCol_ButtonActive] = dim_accent;
    colors[ImGuiCol_Header] = grey(0.17f);
    colors[ImGuiCol_HeaderHovered] = grey(0.24f);
    colors[ImGuiCol_HeaderActive] = grey(0.28f);
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_SliderGrab] = ImVec4(0.80f, 0.53f, 0.40f, 0.62f);  // the number stays readable over it
    colors[ImGuiCol_SliderGrabActive] = accent;
    colors[ImGuiCol_Separator] = grey(0.22f);
    colors[ImGuiCol_PlotLines] = colors[ImGuiCol_PlotHistogram] = accent;
    colors[ImGuiCol_TextSelectedBg] = dim_accent;
    colors[ImGuiCol_ScrollbarBg] = grey(0.1f, 0.5f);
    colors[ImGuiCol_ScrollbarGrab] = grey(0.3f);
}

}  // namespace

void set_style(float scale) {
    ImGuiStyle style;
    set_colors(style);
    style.WindowRounding = 0;
    style.WindowBorderSize = style.FrameBorderSize = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 3;
    style.WindowPadding = {12, 10};
    style.FramePadding = {7, 4};
    style.ItemSpacing = {8, 5};
    style.ItemInnerSpacing = {6, 4};
    style.GrabMinSize = 10;
    style.ScrollbarSize = 11;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

}  // namespace dermis::view
