// The panels of the scene: light, skin, camera.

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/angle.h"
#include "dermis/optics/presets.h"
#include "dermis/optics/tissue/skin_model.h"
#include "dermis/view/panel_parts.h"
#include "dermis/view/widgets.h"

namespace dermis::view {
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
                                  .doc = "direction of the key light, 0 in front of the face",
                                  .min = -180,
                                  .max = 180},
                                 yaw_deg);
        moved |= rows.number({.name = "pitch",
                              .unit = "°",
                              .doc = "direction of the key light, positive upwards",
                              .min = -89,
                              .max = 89},
                             pitch_deg);
        rows.number(
            {.name = "intensity",
             .doc =
                 "irradiance of the key light; pi on a white Lambert surface that faces it gives radiance 1",
             .max = 20,
             .default_value = std::numbers::pi},
            key->intensity);
        rows.color({.name = "color", .unit = "linear", .doc = "colour of the key light", .max = 1},
                   key->color_linear);
        if (moved) {
            key->to_light_world =
                direction_from_yaw_pitch(yaw_deg / kDegreesPerRadian, pitch_deg / kDegreesPerRadian);
            if (!directional) key->position_mm = center_mm + key->to_light_world * length(to_light);
        }
    }
    if (scene.environment.kind == EnvironmentKind::none) return;
    rows.number({.name = "environment",
                 .doc = "factor on the radiance of the environment",
                 .max = 4,
                 .default_value = 1},
                scene.environment.intensity);
    float yaw_deg = scene.environment.yaw_rad * kDegreesPerRadian;
    if (rows.number({.name = "environment_yaw",
                     .unit = "°",
                     .doc = "rotation of the environment about the vertical axis",
                     .min = -180,
                     .max = 180},
                    yaw_deg))
        scene.environment.yaw_rad = yaw_deg / kDegreesPerRadian;
    rows.toggle({.name = "as_background", .doc = "the environment is the background"},
                scene.environment.visible);
}

// The pigments of the skin's profile where it has some, else the usual ones.
void show_pigments(const Skin& skin, PanelRequests& requests, Rows& rows) {
    const Result<SkinModel> read = parse_skin_model(skin.profile);
    SkinModel pigments = read ? *read : SkinModel{};
    const auto slider = [&](const char* name, double SkinModel::*member, double most, const char* doc) {
        auto value = float(pigments.*member);
        if (!rows.number({.name = name, .doc = doc, .max = most, .default_value = SkinModel{}.*member},
                         value))
            return;
        pigments.*member = std::round(double(value) * 1e4) / 1e4;
        requests.pigments = pigments;
    };
    slider("melanin", &SkinModel::melanin, 0.5, "volume fraction in the epidermis; 0.01 light, 0.43 dark");
    slider("blood", &SkinModel::blood, 0.1, "volume fraction in the dermis; 0.015 a face, 0.05 a blush");
    slider("oxygen", &SkinModel::oxygen, 1, "oxygen saturation of the blood");
}

void show_skin(Model& model, PanelRequests& requests, WidgetMap& widgets) {
    static const std::vector<std::string> kTones = {"as the maps are", "I", "II", "III", "IV", "V", "VI"};
    static const std::vector<std::string> kProfiles = profile_names();
    Rows rows(widgets, "skin.");
    int tone = model.tone;
    if (rows.choice(
            {.name = "tone",
             .doc = "the profile of OpenPBR's skin, and a tint that gives the maps the tone's mean colour"},
            kTones, tone))
        requests.tone = tone;
    Skin& skin = model.scene->skin;
    int profile = index_of(kProfiles, skin.profile);
    if (rows.choice({.name = "profile",
                     .doc = "diffusion profile of the skin; see dermis profile",
                     .default_value = double(profile)},
                    kProfiles, profile))
        skin.profile = kProfiles[size_t(profile)];
    show_pigments(skin, requests, rows);
    if (rows.color({.name = "tint", .doc = "multiplies the colour of the skin, linear", .max = 4},
                   skin.albedo_tint_linear))
        model.tone = 0;
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
                            .doc = "from the camera to its target",
                            .min = scene.bounds_radius_mm * 0.05,
                            .max = scene.bounds_radius_mm * 40,
                            .default_value = distance_mm},
                           distance_mm)) {
        camera.eye_mm = camera.target_mm + normalize(to_eye) * distance_mm;
    }
    if (ImGui::Button("Fit  (F)")) requests.actions.push_back(Action::fit);
}

}  // namespace dermis::view
