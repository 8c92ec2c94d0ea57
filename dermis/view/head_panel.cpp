// Unit and materials of the scene's mesh files.

#include <imgui.h>

#include <algorithm>
#include <array>

#include "dermis/base/text.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/part_words.h"
#include "dermis/view/head_words.h"
#include "dermis/view/panel_parts.h"
#include "dermis/view/widgets.h"

namespace dermis::view {
namespace {

struct UsualUnit {
    const char* name;
    double unit_mm;
};
constexpr std::array kUsualUnits = {UsualUnit{"millimetre", 1}, UsualUnit{"centimetre", 10},
                                    UsualUnit{"inch", 25.4},    UsualUnit{"decimetre", 100},
                                    UsualUnit{"foot", 304.8},   UsualUnit{"metre", 1000}};

// The wanted unit: of a change that is not loaded yet, else of the mesh.
double wanted_unit_mm(const Model& model, const HeadMesh& mesh) {
    const auto word = std::ranges::find(model.loading_words, mesh.unit_key, &SceneWord::key);
    if (word == model.loading_words.end()) return mesh.unit_mm;
    return parse_number(word->value).value_or(mesh.unit_mm);
}

void show_unit(Model& model, const HeadMesh& mesh, bool is_only_one, WidgetMap& widgets) {
    if (!is_only_one) ImGui::TextDisabled("%s", mesh.name.c_str());
    Rows rows(widgets, is_only_one ? "head." : "head." + mesh.name + ".");
    const double unit_mm = wanted_unit_mm(model, mesh);
    std::vector<std::string> names;
    int index = -1;
    for (const UsualUnit& unit : kUsualUnits) {
        if (std::abs(unit.unit_mm / unit_mm - 1) < 1e-5) index = int(names.size());
        names.emplace_back(unit.name);
    }
    const auto want = [&](const std::string& value) {
        put_word(model.loading_words, {mesh.unit_key, value});
    };
    if (rows.choice(
            {.name = "unit", .doc = "length of one unit of the mesh file", .default_value = double(index)},
            names, index))
        want(to_text(kUsualUnits[size_t(index)].unit_mm));
    auto number = float(unit_mm);
    if (rows.number(
            {.name = "length_mm",
             .unit = "mm",
             .doc = "the same in mm; the camera follows, and the skin scatters as far as in this size",
             .min = 0.01,
             .max = 10000,
             .default_value = mesh.unit_mm},
            number))
        want(to_text(number));
}

void tooltip_of(const HeadMaterial& material) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::Text("%s", printable_line(material.name).c_str());
    ImGui::TextDisabled("%s: %s", part_name(material.part).c_str(), printable_line(material.reason).c_str());
    ImGui::TextDisabled("maps: %s", material.maps.empty() ? "none" : material.maps.c_str());
    ImGui::EndTooltip();
}

// A choice without a label; the last row's width is that of the column.
bool plain_choice(const std::string& id, const std::vector<std::string>& names, int& index,
                  WidgetMap& widgets) {
    const bool known = index >= 0 && size_t(index) < names.size();
    ImGui::SetNextItemWidth(-1);
    const bool open =
        ImGui::BeginCombo(("##" + id).c_str(), known ? label_of(names[size_t(index)]).c_str() : "",
                          ImGuiComboFlags_HeightLarge);
    name_widget(widgets, id);
    if (!open) return false;
    bool changed = false;
    for (int i = 0; i < int(names.size()); ++i)
        if (ImGui::Selectable(label_of(names[size_t(i)]).c_str(), i == index)) index = i, changed = true;
    ImGui::EndCombo();
    return changed;
}

void show_profile(Model& model, const HeadMaterial& material, const std::string& word, WidgetMap& widgets) {
    static const std::vector<std::string> kProfiles = [] {
        std::vector<std::string> names = profile_names();
        names.insert(names.begin(), "as the scene's skin");
        return names;
    }();
    int profile = material.profile.empty() ? 0 : index_of(kProfiles, material.profile);
    const bool of_pigments = profile < 0;
    if (plain_choice("head." + material.name + ".profile", kProfiles, profile, widgets))
        put_word(model.loading_words, {word + "profile", profile == 0 ? "" : kProfiles[size_t(profile)]});
    if (of_pigments) ImGui::TextDisabled("%s", printable_line(material.profile).c_str());
}

void show_material(Model& model, const HeadMaterial& material, WidgetMap& widgets) {
    const std::string word = "material." + material.name + ".", widget = "head." + material.name + ".";
    const float part_width = ImGui::CalcTextSize("translucent").x + 2 * ImGui::GetFrameHeight();
    bool visible = material.visible;
    ImGui::PushID(material.name.c_str());
    const float right = ImGui::GetContentRegionAvail().x - part_width;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Checkbox("##visible", &visible))
        put_word(model.loading_words, {word + "visible", visible ? "true" : "false"});
    name_widget(widgets, widget + "visible");
    ImGui::SameLine();
    ImGui::PushClipRect(at, {at.x + right - ImGui::GetStyle().ItemSpacing.x, at.y + ImGui::GetFrameHeight()},
                        true);
    ImGui::TextUnformatted(printable_line(material.name).c_str());
    ImGui::PopClipRect();
    tooltip_of(material);
    ImGui::SameLine(ImGui::GetCursorStartPos().x + right);
    int part = int(std::ranges::find(part_names(), part_name(material.part)) - part_names().begin());
    if (plain_choice(widget + "class", part_names(), part, widgets))
        put_word(model.loading_words, {word + "class", part_names()[size_t(part)]});
    ImGui::Indent(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x);
    if (!material.maps.empty()) ImGui::TextDisabled("%s", material.maps.c_str());
    if (material.part == HeadPart::skin) show_profile(model, material, word, widgets);
    ImGui::Unindent(ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x);
    ImGui::PopID();
}

}  // namespace

void show_head(Model& model, WidgetMap& widgets) {
    const std::vector<HeadMesh> meshes = meshes_of(*model.scene);
    for (const HeadMesh& mesh : meshes) show_unit(model, mesh, meshes.size() == 1, widgets);
    for (const HeadMaterial& material : materials_of(*model.scene)) show_material(model, material, widgets);
}

}  // namespace dermis::view
