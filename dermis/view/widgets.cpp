#include "dermis/view/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"

namespace dermis::view {
namespace {

constexpr float kLabelShare = 0.42f;

std::string range_text(const NumberRow& row) {
    return to_text(float(row.min)) + " to " + to_text(float(row.max)) +
           (row.unit.empty() ? "" : " " + row.unit);
}

// To the side of the column: below the mouse it would hide the rows that follow.
void tooltip(const std::string& text, const std::string& detail) {
    if (text.empty() && detail.empty()) return;
    const float gap = ImGui::GetStyle().WindowPadding.x / 2;
    ImGui::SetNextWindowPos({ImGui::GetWindowPos().x - gap, ImGui::GetItemRectMin().y}, ImGuiCond_Always,
                            {1, 0});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text.c_str());
    if (!detail.empty()) ImGui::TextDisabled("%s", detail.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

// Enough digits for a hundredth of the range. A '%' in a unit is doubled, or it would be a format.
std::string format_of(const NumberRow& row) {
    const double step = std::max((row.max - row.min) / 200, 1e-6);
    const int digits = row.whole ? 0 : std::clamp(int(std::ceil(-std::log10(step))), 0, 5);
    std::string unit = row.unit;
    for (size_t at = 0; (at = unit.find('%', at)) != unit.npos; at += 2) unit.insert(at, 1, '%');
    const bool close = unit.empty() || unit == "°";
    return "%." + std::to_string(digits) + "f" + (close ? "" : " ") + unit;
}

// Ranges over more than two decades are logarithmic.
ImGuiSliderFlags flags_of(const NumberRow& row) {
    const bool decades = row.min > 0 && row.max / row.min > 100;
    return ImGuiSliderFlags_AlwaysClamp | (decades ? ImGuiSliderFlags_Logarithmic : 0);
}

NumberRow row_of(const Parameter& parameter) {
    return {.name = parameter.name,
            .unit = parameter.unit,
            .doc = parameter.doc,
            .min = parameter.min,
            .max = parameter.max,
            .default_value = parameter.default_value[0],
            .whole = parameter.kind == ParameterKind::integer};
}

}  // namespace

std::string label_of(const std::string& name) {
    std::string label = name;
    for (const char* unit : {"_mm", "_ev", "_deg", "_per_mm", "_rad", "_linear"})
        if (label.ends_with(unit)) label.resize(label.size() - std::string_view(unit).size());
    std::ranges::replace(label, '_', ' ');
    return label;
}

void Rows::begin(const NumberRow& row, bool changed_from_default) {
    ImGui::AlignTextToFramePadding();
    const float label_width = ImGui::GetContentRegionAvail().x * kLabelShare;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushClipRect(at, {at.x + label_width - 4, at.y + ImGui::GetFrameHeight()}, true);
    if (changed_from_default)
        ImGui::TextUnformatted(label_of(row.name).c_str());
    else
        ImGui::TextDisabled("%s", label_of(row.name).c_str());
    ImGui::PopClipRect();
    ImGui::SameLine(ImGui::GetCursorStartPos().x + label_width);
    ImGui::SetNextItemWidth(-1);
}

// True when the default is to be restored.
bool Rows::end(const NumberRow& row) {
    name_widget(*widgets_, prefix_ + row.name);
    if (!ImGui::IsItemHovered()) return false;
    if (!ImGui::IsItemActive()) tooltip(row.doc, row.whole || row.max > row.min ? range_text(row) : "");
    return ImGui::IsMouseClicked(ImGuiMouseButton_Right);
}

bool Rows::number(const NumberRow& row, float& value) {
    begin(row, value != float(row.default_value));
    const std::string id = this->id(row), format = format_of(row);
    bool changed = false;
    if (row.whole) {
        int whole = int(std::lround(value));
        changed = ImGui::SliderInt(id.c_str(), &whole, int(row.min), int(row.max), format.c_str(),
                                   ImGuiSliderFlags_AlwaysClamp);
        if (changed) value = float(whole);
    } else {
        changed = ImGui::SliderFloat(id.c_str(), &value, float(row.min), float(row.max), format.c_str(),
                                     flags_of(row));
    }
    if (end(row)) value = float(row.default_value), changed = true;
    return changed;
}

bool Rows::color(const NumberRow& row, Vec3& value) {
    begin(row, true);
    const std::string id = this->id(row);
    const bool changed =
        ImGui::ColorEdit3(id.c_str(), &value.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    end(row);
    return changed;
}

bool Rows::toggle(const NumberRow& row, bool& value) {
    begin(row, float(value) != float(row.default_value));
    const std::string id = this->id(row);
    NumberRow no_range = row;
    no_range.max = no_range.min;
    bool changed = ImGui::Checkbox(id.c_str(), &value);
    if (end(no_range)) value = row.default_value != 0, changed = true;
    return changed;
}

bool Rows::choice(const NumberRow& row, const std::vector<std::string>& names, int& index) {
    begin(row, float(index) != float(row.default_value));
    const std::string id = this->id(row);
    const bool known = index >= 0 && size_t(index) < names.size();
    bool changed = false;
    const bool open = ImGui::BeginCombo(id.c_str(), known ? label_of(names[size_t(index)]).c_str() : "",
                                        ImGuiComboFlags_HeightLarge);
    NumberRow no_range = row;
    no_range.max = no_range.min;
    const bool reset = !open && end(no_range);
    if (open) {
        for (int i = 0; i < int(names.size()); ++i)
            if (ImGui::Selectable(label_of(names[size_t(i)]).c_str(), i == index)) index = i, changed = true;
        ImGui::EndCombo();
    }
    if (reset) index = int(row.default_value), changed = true;
    return changed;
}

bool Rows::parameter(const Parameter& parameter, ParameterValues& values) {
    const NumberRow row = row_of(parameter);
    std::array<double, 3> value = values.get(parameter);
    auto number_value = float(value[0]);
    int index = int(value[0]);
    bool on = value[0] != 0, changed = false;
    Vec3 color_value = {float(value[0]), float(value[1]), float(value[2])};
    switch (parameter.kind) {
        case ParameterKind::number:
        case ParameterKind::integer:
            changed = number(row, number_value);
            value[0] = number_value;
            break;
        case ParameterKind::toggle:
            changed = toggle(row, on);
            value[0] = on;
            break;
        case ParameterKind::choice:
            changed = choice(row, parameter.choices, index);
            value[0] = index;
            break;
        case ParameterKind::color:
            changed = color(row, color_value);
            value = {color_value.x, color_value.y, color_value.z};
            break;
    }
    if (changed) values.put(parameter, value);
    return changed;
}

int fixed_window() {
    return ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
           ImGuiWindowFlags_NoNav;
}

int index_of(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? -1 : int(found - names.begin());
}

bool section(const char* title, bool open_at_first, WidgetMap& widgets) {
    ImGui::Spacing();
    const bool open = ImGui::CollapsingHeader(title, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    name_widget(widgets, std::string("section.") + title);
    return open;
}

void name_widget(WidgetMap& widgets, const std::string& name) {
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    widgets[name] = {min.x, min.y, max.x - min.x, max.y - min.y};
}

}  // namespace dermis::view
