// The panels of the technique with its parameters, the view, and the comparison.

#include <imgui.h>

#include <cassert>

#include "dermis/render/shared_passes.h"
#include "dermis/view/panel_parts.h"
#include "dermis/view/widgets.h"

namespace dermis::view {
namespace {

// Empty while the values are those of no preset.
void show_presets(Rows& rows, ParameterValues& values) {
    const std::vector<ParameterPreset>& presets = values.table().presets;
    if (presets.size() < 2) return;
    std::vector<std::string> names;
    for (const ParameterPreset& preset : presets) names.push_back(preset.name);
    const ParameterPreset* now = values.preset();
    int index = now ? int(now - presets.data()) : -1;
    const NumberRow row = {.name = "preset", .doc = now ? now->doc : "sets all parameters below"};
    if (rows.choice(row, names, index) && !values.set("preset", names[size_t(index)]))
        assert(false && "a preset of the table is known by its name");
}

}  // namespace

void show_technique(Model& model, size_t choice, PanelRequests& requests, WidgetMap& widgets) {
    TechniqueChoice& chosen = model.choices[choice];
    std::vector<std::string> ids;
    for (const Technique& technique : model.catalog.techniques) ids.push_back(technique.id);
    int index = index_of(ids, chosen.technique().id);
    Rows rows(widgets, choice == 0 ? "" : "b.");
    const NumberRow row = {
        .name = "technique", .doc = chosen.technique().source, .default_value = double(index)};
    if (rows.choice(row, ids, index)) chosen.choose(model.catalog.techniques[size_t(index)]);
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s", chosen.technique().summary.c_str());
    ImGui::PopTextWrapPos();
    show_presets(rows, chosen.values());
    for (const Parameter& parameter : chosen.technique().parameters.parameters)
        rows.parameter(parameter, chosen.values());
    if (choice == 0 && !chosen.technique().parameters.parameters.empty() && ImGui::SmallButton("defaults"))
        requests.actions.push_back(Action::reset_parameters);
}

void show_view(Model& model, WidgetMap& widgets) {
    const std::vector<std::string> names = view_names(model.choices[0].technique());
    int index = index_of(names, model.view);
    Rows rows(widgets, "picture.");
    if (rows.choice({.name = "view", .doc = "the final picture, its parts, or an input of the shading"},
                    names, index))
        model.view = names[size_t(index)];
    if (!model.scene) return;
    rows.number(
        {.name = "exposure_ev", .unit = "stops", .doc = "scales radiance by 2^x", .min = -6, .max = 6},
        model.scene->exposure_ev);
    static const std::vector<std::string> kToneMaps(tone_map_names().begin(), tone_map_names().end());
    int tone_map = int(model.scene->tone_map);
    if (rows.choice({.name = "tone_map", .doc = "from radiance to the display", .default_value = 1},
                    kToneMaps, tone_map))
        model.scene->tone_map = ToneMap(tone_map);
}

void show_compare(Model& model, PanelRequests& requests, WidgetMap& widgets) {
    static const std::vector<std::string> kModes = {"off", "wipe", "side by side"};
    Rows rows(widgets, "compare.");
    int mode = int(model.compare);
    if (rows.choice({.name = "mode", .doc = "two techniques on one head; drag the white line"}, kModes, mode))
        model.compare = Compare(mode);
    if (!model.compares()) return;
    if (model.reference_path.empty()) {
        if (ImGui::Button("Swap sides  (X)")) requests.actions.push_back(Action::swap_sides);
        ImGui::TextDisabled("right side");
        show_technique(model, 1, requests, widgets);
        return;
    }
    ImGui::TextDisabled("right side: %s", model.reference_path.c_str());
    if (ImGui::Button("Compare with a technique")) model.reference_path.clear();
}

}  // namespace dermis::view
