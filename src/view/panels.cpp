#include "dermis/view/panels.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "dermis/optics/presets.h"
#include "dermis/render/shared_passes.h"
#include "dermis/view/widgets.h"

namespace dermis::view {
namespace {

constexpr float kColumnWidth = 330, kStatusHeight = 26;
constexpr float kDegreesPerRadian = 180 / std::numbers::pi_v<float>;

int index_of(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? -1 : int(found - names.begin());
}

void show_technique(Model& model, size_t choice, PanelRequests& requests, WidgetMap& widgets) {
    TechniqueChoice& chosen = model.choices[choice];
    std::vector<std::string> ids;
    for (const Technique& technique : all_techniques()) ids.push_back(technique.id);
    int index = index_of(ids, chosen.technique().id);
    Rows rows(widgets, choice == 0 ? "" : "b.");
    const NumberRow row = {
        .name = "technique", .doc = chosen.technique().source, .default_value = double(index)};
    if (rows.choice(row, ids, index)) chosen.choose(all_techniques()[size_t(index)]);
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s", chosen.technique().summary.c_str());
    ImGui::PopTextWrapPos();
    for (const Parameter& parameter : chosen.technique().parameters.parameters)
        rows.parameter(parameter, chosen.values());
    if (choice == 0 && !chosen.technique().parameters.parameters.empty() && ImGui::SmallButton("defaults"))
        requests.actions.push_back(Action::reset_parameters);
}

void show_view(Model& model, WidgetMap& widgets) {
    const std::vector<std::string> names = view_names(model.choices[0].technique());
    int index = index_of(names, model.view);
    Rows rows(widgets, "picture.");
    if (rows.choice({.name = "view", .doc = "the picture, its parts, or what the shading was given"}, names,
                    index))
        model.view = names[size_t(index)];
    if (!model.scene) return;
    rows.number(
        {.name = "exposure_ev", .unit = "stops", .doc = "scales radiance by 2^x", .min = -6, .max = 6},
        model.scene->exposure_ev);
    static const std::vector<std::string> kToneMaps = {"none", "hable", "aces", "pbr_neutral"};
    int tone_map = int(model.scene->tone_map);
    if (rows.choice({.name = "tone_map", .doc = "from radiance to the display", .default_value = 1},
                    kToneMaps, tone_map))
        model.scene->tone_map = ToneMap(tone_map);
}

void show_light(Scene& scene, WidgetMap& widgets) {
    const auto key = std::ranges::find(scene.lights, true, &Light::is_key);
    Rows rows(widgets, "light.");
    if (key != scene.lights.end()) {
        const bool directional = key->kind == LightKind::directional;
        const Vec3 center_mm = scene.bounds_center_mm;
        const Vec3 to_light = directional ? key->to_light_world : key->position_mm - center_mm;
        const YawPitch angles = yaw_pitch_of(to_light);
        float yaw_deg = angles.yaw_rad * kDegreesPerRadian, pitch_deg = angles.pitch_rad * kDegreesPerRadian;
        bool moved = rows.number({.name = "yaw",
                                  .unit = "°",
                                  .doc = "of the key light, 0 in front of the face",
                                  .min = -180,
                                  .max = 180},
                                 yaw_deg);
        moved |= rows.number(
            {.name = "pitch", .unit = "°", .doc = "of the key light, upwards", .min = -89, .max = 89},
            pitch_deg);
        rows.number({.name = "intensity",
                     .doc = "of the key light: pi on a white wall that faces it gives radiance 1",
                     .max = 20,
                     .default_value = std::numbers::pi},
                    key->intensity);
        rows.color({.name = "color", .unit = "linear", .doc = "of the key light", .max = 1},
                   key->color_linear);
        if (moved) {
            key->to_light_world =
                direction_from_yaw_pitch(yaw_deg / kDegreesPerRadian, pitch_deg / kDegreesPerRadian);
            if (!directional) key->position_mm = center_mm + key->to_light_world * length(to_light);
        }
    }
    if (scene.environment.kind == EnvironmentKind::none) return;
    rows.number(
        {.name = "surroundings", .doc = "how much light comes from all around", .max = 4, .default_value = 1},
        scene.environment.intensity);
    float yaw_deg = scene.environment.yaw_rad * kDegreesPerRadian;
    if (rows.number({.name = "turned",
                     .unit = "°",
                     .doc = "the surroundings about the vertical",
                     .min = -180,
                     .max = 180},
                    yaw_deg))
        scene.environment.yaw_rad = yaw_deg / kDegreesPerRadian;
    rows.toggle({.name = "in_the_picture", .doc = "the surroundings as the background"},
                scene.environment.visible);
}

void show_skin(Model& model, PanelRequests& requests, WidgetMap& widgets) {
    static const std::vector<std::string> kTones = {"as the maps are", "I", "II", "III", "IV", "V", "VI"};
    static const std::vector<std::string> kProfiles = profile_names();
    Rows rows(widgets, "skin.");
    int tone = model.tone;
    if (rows.choice({.name = "tone",
                     .doc = "OpenPBR's six skins: profile, and a tint that gives the maps their mean colour"},
                    kTones, tone))
        requests.tone = tone;
    Skin& skin = model.scene->skin;
    int profile = index_of(kProfiles, skin.profile);
    if (rows.choice({.name = "profile",
                     .doc = "how far light travels inside; see dermis profile",
                     .default_value = double(profile)},
                    kProfiles, profile))
        skin.profile = kProfiles[size_t(profile)];
    rows.color({.name = "tint", .doc = "multiplies the colour of the skin, linear", .max = 4},
               skin.albedo_tint_linear);
}

void show_compare(Model& model, PanelRequests& requests, WidgetMap& widgets) {
    static const std::vector<std::string> kModes = {"off", "wipe", "side by side"};
    Rows rows(widgets, "compare.");
    int mode = int(model.compare);
    if (rows.choice({.name = "mode", .doc = "two techniques on one head; drag the white line"}, kModes, mode))
        model.compare = Compare(mode);
    if (!model.compares()) return;
    if (model.truth_path.empty()) {
        if (ImGui::Button("Swap sides  (X)")) requests.actions.push_back(Action::swap_sides);
        ImGui::TextDisabled("right side");
        show_technique(model, 1, requests, widgets);
        return;
    }
    ImGui::TextDisabled("right side: %s", model.truth_path.c_str());
    if (ImGui::Button("A technique instead")) model.truth_path.clear();
}

// A list that opens over its button.
void show_recent(const Model& model, PanelRequests& requests) {
    if (model.recent.size() < 2) return;
    const float width = ImGui::CalcTextSize("recent").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
    if (ImGui::SmallButton("recent")) ImGui::OpenPopup("recent scenes");
    if (!ImGui::BeginPopup("recent scenes")) return;
    for (const std::string& path : model.recent)
        if (ImGui::Selectable(path.c_str())) requests.open = path;
    ImGui::EndPopup();
}

void show_camera(Scene& scene, PanelRequests& requests, WidgetMap& widgets) {
    Rows rows(widgets, "camera.");
    Camera& camera = scene.camera;
    float fov_deg = camera.vertical_fov_rad * kDegreesPerRadian;
    const Vec3 to_eye = camera.eye_mm - camera.target_mm;
    float distance_mm = length(to_eye);
    if (rows.number({.name = "lens",
                     .unit = "°",
                     .doc = "vertical field of view; the head keeps its size",
                     .min = 3,
                     .max = 90,
                     .default_value = 30},
                    fov_deg)) {
        const float kept = std::tan(camera.vertical_fov_rad / 2) / std::tan(fov_deg / kDegreesPerRadian / 2);
        camera.vertical_fov_rad = fov_deg / kDegreesPerRadian;
        camera.eye_mm = camera.target_mm + to_eye * kept;
    } else if (rows.number({.name = "distance_mm",
                            .unit = "mm",
                            .doc = "from the eye to what it looks at",
                            .min = scene.bounds_radius_mm * 0.05,
                            .max = scene.bounds_radius_mm * 40,
                            .default_value = distance_mm},
                           distance_mm)) {
        camera.eye_mm = camera.target_mm + normalize(to_eye) * distance_mm;
    }
    if (ImGui::Button("Fit  (F)")) requests.actions.push_back(Action::fit);
}

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

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;

void show_column(Model& model, const PanelFacts& facts, PanelRequests& requests, WidgetMap& widgets) {
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    ImGui::SetNextWindowPos({picture.x + picture.width, 0});
    ImGui::SetNextWindowSize({float(facts.width) - picture.width, float(facts.height)});
    ImGui::Begin("settings", nullptr, kFixed & ~ImGuiWindowFlags_NoScrollbar);
    if (model.scene) {
        ImGui::TextUnformatted(model.scene->name.c_str());
        show_recent(model, requests);
        ImGui::PushTextWrapPos(0);
        if (!model.scene->credit.empty()) ImGui::TextDisabled("%s", model.scene->credit.c_str());
        ImGui::PopTextWrapPos();
    }
    if (section("Technique", true)) show_technique(model, 0, requests, widgets);
    if (section("Picture", true)) show_view(model, widgets);
    if (model.scene && section("Skin", false)) show_skin(model, requests, widgets);
    if (section("Compare", true)) show_compare(model, requests, widgets);
    if (model.scene && section("Light", true)) show_light(*model.scene, widgets);
    if (model.scene && section("Camera", false)) show_camera(*model.scene, requests, widgets);
    if (section("Time", true)) show_times(facts);
    ImGui::End();
}

void show_status(const Model& model, const PanelFacts& facts) {
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    ImGui::SetNextWindowPos({0, picture.height});
    ImGui::SetNextWindowSize({picture.width, float(facts.height) - picture.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(12 * facts.scale, 4 * facts.scale));
    ImGui::Begin("status", nullptr, kFixed | ImGuiWindowFlags_NoInputs);
    if (facts.probe.empty())
        ImGui::TextDisabled("%s   %s", facts.picture_state.c_str(), facts.loading ? "loading …" : "");
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

void show_notices(const Model& model, const PanelFacts& facts) {
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    float bottom = picture.height - 10 * facts.scale;
    for (const Notice& notice : model.notices.all()) {
        ImGui::SetNextWindowPos({12 * facts.scale, bottom}, ImGuiCond_Always, {0, 1});
        ImGui::SetNextWindowSizeConstraints({0, 0}, {picture.width - 24 * facts.scale, picture.height});
        ImGui::SetNextWindowBgAlpha(0.9f);
        ImGui::Begin(("notice " + notice.topic).c_str(), nullptr,
                     kFixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_NoInputs);
        if (notice.is_error) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.96f, 0.52f, 0.45f, 1));
        ImGui::PushTextWrapPos(std::min(picture.width - 48 * facts.scale, ImGui::GetFontSize() * 52));
        ImGui::TextUnformatted(notice.text.c_str());
        ImGui::PopTextWrapPos();
        if (notice.is_error) ImGui::PopStyleColor();
        bottom -= ImGui::GetWindowHeight() + 6 * facts.scale;
        ImGui::End();
    }
}

// Which side is which, on a dark plate so that it reads over any picture.
void show_side_name(const std::string& name, float x, float scale, bool to_the_left) {
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    const float pad = 6 * scale, left = to_the_left ? x - size.x - 2 * pad : x;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({left, pad}, {left + size.x + 2 * pad, 2 * pad + size.y + pad},
                       IM_COL32(20, 20, 20, 170), 3 * scale);
    list.AddText({left + pad, 1.5f * pad + pad * 0.5f}, IM_COL32(225, 225, 225, 255), name.c_str());
}

void show_side_names(const Model& model, const PanelFacts& facts) {
    if (!model.compares() || !model.scene) return;
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    const std::string right = model.truth_path.empty()
                                  ? model.choices[1].technique().id
                                  : std::filesystem::path(model.truth_path).filename().string();
    const std::string stale = model.truth_is_of_another_view ? ", of another view (G: of this one)" : "";
    const float split = model.compare == Compare::wipe ? model.split : 0.5f;
    const float line = picture.x + picture.width * split, gap = 6 * facts.scale;
    show_side_name(model.choices[0].technique().id, line - gap, facts.scale, true);
    show_side_name(right + stale, line + gap, facts.scale, false);
}

void help_table(const char* id, std::span<const std::pair<std::string, std::string>> rows) {
    if (!ImGui::BeginTable(id, 2)) return;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 13);
    ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 27);
    for (const auto& [what, meaning] : rows) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(what.c_str());
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", meaning.c_str());
    }
    ImGui::EndTable();
}

void show_help(const Model& model, const PanelFacts& facts) {
    const Region picture = picture_region(model, facts.width, facts.height, facts.scale);
    ImGui::SetNextWindowPos({picture.width / 2, picture.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.97f);
    ImGui::Begin("help", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
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
    show_side_names(model, facts);
    show_notices(model, facts);
    if (model.show_help) show_help(model, facts);
}

}  // namespace dermis::view
