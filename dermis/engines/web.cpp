#include "dermis/engines/web.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/engines/engine.h"
#include "dermis/engines/web/parts.h"
#include "dermis/optics/fresnel.h"
#include "dermis/render/renderer.h"
#include "dermis/scene/rig_scene.h"
#include "shaders/include/constants.h"

namespace dermis::inline engines {
namespace {

using nlohmann::json;
using web::to_json;

constexpr std::string_view kPageFolder = "engines/web/", kMotionFolder = "engines/common/";
constexpr size_t kMaxTones = 16, kMaxLights = 4, kMaxMotionBytes = 2'000'000;

Result<std::string> text_of(std::span<const shading::Source> texts, std::string_view path) {
    const auto found = std::ranges::find(texts, path, &shading::Source::path);
    if (found == texts.end()) return Error{std::string(path) + " is not among the page's texts"};
    return found->text;
}

// They are read in order, so what includes one of them finds it already.
std::string without_includes(std::string_view text) {
    std::string kept;
    for (const std::string_view line : split(text, '\n'))
        if (!line.starts_with("#include")) kept += std::string(line) + "\n";
    while (kept.ends_with("\n\n")) kept.pop_back();
    return kept;
}

Result<void> add_texts(const WebInput& input, std::vector<WebFile>& files) {
    for (const shading::Source& text : input.texts)
        for (const std::string_view folder : {kPageFolder, kMotionFolder})
            if (text.path.starts_with(folder))
                files.push_back({text.path.substr(folder.size()), to_bytes(text.text)});
    if (files.empty()) return Error{"the page's own files are not among the texts"};
    DERMIS_TRY_ASSIGN(const std::string license, text_of(input.texts, "LICENSE"));
    files.push_back({"LICENSE.txt", to_bytes(license)});
    std::string shared;
    for (const std::string_view path : input.shared_shaders) {
        DERMIS_TRY_ASSIGN(const std::string text, text_of(input.texts, path));
        shared += "// " + std::string(path) + "\n" + without_includes(text) + "\n";
    }
    files.push_back({"shared.glsl", to_bytes(shared)});
    DERMIS_TRY_ASSIGN(const std::vector<shading::Unit> units, shading::read_sources(input.functions));
    const std::vector<std::string> heading = {
        "Shading functions for skin, printed by `dermis export`; change their source, not this file.",
        "SPDX-License-Identifier: MIT, Copyright (c) 2026 The Dermis authors", "",
        "Units: lengths in mm, curvature in 1/mm, colours linear."};
    files.push_back({"skin.essl", to_bytes(shading::print(units, shading::Language::essl, heading))});
    return {};
}

json camera_json(const Camera& camera) {
    return {{"eye_mm", to_json(camera.eye_mm)},
            {"target_mm", to_json(camera.target_mm)},
            {"vertical_fov_rad", to_json(camera.vertical_fov_rad)}};
}

// A point or spot light as if it were distant: direction and irradiance at the middle of the scene.
json light_json(const Light& light, Vec3 center_mm) {
    Vec3 to_light = light.to_light_world, irradiance = light.color_linear * light.intensity;
    if (light.kind != LightKind::directional) {
        const Vec3 offset_mm = light.position_mm - center_mm;
        const float distance_m = std::max(length(offset_mm) * 1e-3f, 1e-3f);
        to_light = offset_mm;
        irradiance = irradiance * (1 / (distance_m * distance_m));
    }
    return {{"to_light", to_json(normalize(to_light))},
            {"irradiance_linear", to_json(irradiance)},
            {"key", light.is_key}};
}

json lights_json(const Scene& scene, std::vector<std::string>& warnings) {
    json lights = json::array();
    for (const Light& light : scene.lights) {
        if (lights.size() == kMaxLights) {
            warnings.push_back(
                fmt::format("the page draws {} lights; the others of the scene are left out", kMaxLights));
            break;
        }
        if (light.kind != LightKind::directional)
            warnings.push_back("light '" + light.name + "' is drawn as if it were distant");
        if (light.casts_shadow && !light.is_key)
            warnings.push_back("light '" + light.name +
                               "' casts no shadow on the page: the key light alone does");
        lights.push_back(light_json(light, scene.bounds_center_mm));
    }
    return lights;
}

json tones_json(std::span<const WebTone> tones) {
    json all = json::array();
    for (const WebTone& tone : tones) {
        json weights = json::array();
        for (const Vec3 weight : tone.occlusion_weights) weights.push_back(to_json(weight));
        all.push_back({{"name", tone.name},
                       {"description", tone.description},
                       {"albedo_tint_linear", to_json(tone.albedo_tint_linear)},
                       {"mean_albedo_linear", to_json(tone.mean_albedo_linear)},
                       {"occlusion_weights", weights},
                       {"gain_form_mm",
                        {to_json(to_vec3(tone.gain.slope_mm)), to_json(to_vec3(tone.gain.length_mm)),
                         to_json(to_vec3(tone.gain.bend_mm))}}});
    }
    return all;
}

int normal_space(const Material& material) {
    if (!material.normal_map.present()) return kNormalSpaceAbsent;
    return material.normal_space == NormalSpace::object ? kNormalSpaceObject : kNormalSpaceTangent;
}

json material_json(const Material& material, MaterialClass material_class) {
    return {{"skin", material_class == MaterialClass::skin},
            {"albedo_linear", to_json(material.base_color_linear)},
            {"roughness", to_json(material.roughness)},
            {"f0", to_json(float(f0_of_eta(material.ior)) * material.specular)},
            {"normal_space", normal_space(material)},
            {"normal_scale", to_json(material.normal_scale)}};
}

// scene.bin and motion.bin.
struct Binaries {
    web::Binary scene, motion;
};

// Nothing for an object that does not move.
Result<json> motion_json(const WebInput& input, const SceneObject& object,
                         std::span<const uint32_t> number_on_page, Binaries& binaries, WebPage& page) {
    if (object.motion.empty()) return json();
    SceneObject moving = object;
    moving.mesh = web::with_tangents(object.mesh);
    const Pose pose = input.scene.motion.pose();
    DERMIS_TRY_ASSIGN(const std::optional<Rig> rig, rig_of(moving, pose));
    if (!rig) {
        page.warnings.push_back("'" + object.name +
                                "' does not move on the page: it is subdivided or displaced");
        return json();
    }
    DERMIS_TRY_ASSIGN(const std::vector<TargetCurvature> curvatures,
                      target_curvatures(object, pose, web::used_targets(*rig)));
    return web::add_motion(binaries.motion, *rig, curvatures, number_on_page);
}

// Without clips the page needs nothing of what moves; too large a motion is left out.
void finish_motion(json& objects, Binaries& binaries, WebPage& page) {
    const bool plays = std::ranges::any_of(objects, [](const json& object) {
        return object.contains("motion") && !object["motion"]["animations"].empty();
    });
    const bool fits = binaries.motion.size() <= kMaxMotionBytes;
    if (plays && !fits)
        page.warnings.push_back(fmt::format(
            "the page shows the scene's pose alone: its clips would take {:.1f} MB, and the limit is {:.1f}",
            double(binaries.motion.size()) / 1e6, double(kMaxMotionBytes) / 1e6));
    if (plays && fits) {
        page.files.push_back({"motion.bin", binaries.motion.finish()});
        return;
    }
    for (json& object : objects) object.erase("motion");
}

// Adds mesh and maps; parts that the page cannot draw are left out of its list.
Result<json> object_json(const WebInput& input, size_t index, Binaries& binaries, WebPage& page) {
    const SceneObject& object = input.scene.objects[index];
    Result<web::MeshOnPage> mesh = web::add_mesh(binaries.scene, object.mesh, input.triangle_count);
    if (!mesh) return Error{object.name + ": " + mesh.error().message};
    json made = std::move(mesh->json);
    DERMIS_TRY_ASSIGN(json motion, motion_json(input, object, mesh->number, binaries, page));
    if (!motion.is_null()) made["motion"] = std::move(motion);
    json parts = json::array();
    std::vector<json> materials(object.mesh.materials.size());
    for (size_t i = 0; i < object.mesh.submeshes.size(); ++i) {
        const uint32_t number = object.mesh.submeshes[i].material;
        const Material& material = object.mesh.materials[number];
        const bool translucent = object.classes[number] == MaterialClass::translucent;
        if (translucent || cutoff_of_map(material) > 0) {
            page.warnings.push_back("material '" + material.name + "' is " +
                                    (translucent ? "translucent" : "cut out by its alpha") +
                                    ", which the page does not draw");
            continue;
        }
        if (materials[number].is_null()) {
            materials[number] = material_json(material, object.classes[number]);
            const std::string prefix = fmt::format("{}_{}", index, number);
            DERMIS_TRY_ASSIGN(json maps,
                              web::add_maps(page.files, material, object.mesh, prefix, input.map_side));
            materials[number].update(maps);
        }
        json part = made["parts"][i];
        part["material"] = materials[number];
        parts.push_back(std::move(part));
    }
    made["parts"] = std::move(parts);
    return made;
}

Result<json> scene_json(const WebInput& input, Binaries& binaries, WebPage& page) {
    const Scene& scene = input.scene;
    DERMIS_TRY_ASSIGN(json tables,
                      web::add_tables(binaries.scene, input.tones, input.table_max_curvature_per_mm));
    DERMIS_TRY_ASSIGN(json environment, web::add_environment(binaries.scene, scene.environment));
    json objects = json::array();
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        DERMIS_TRY_ASSIGN(json object, object_json(input, i, binaries, page));
        objects.push_back(std::move(object));
    }
    finish_motion(objects, binaries, page);
    return json{
        {"name", scene.name},
        {"credit", scene.credit},
        {"camera", camera_json(scene.camera)},
        {"bounds",
         {{"center_mm", to_json(scene.bounds_center_mm)}, {"radius_mm", to_json(scene.bounds_radius_mm)}}},
        {"background_linear", to_json(scene.background_linear)},
        {"exposure", to_json(std::exp2(scene.exposure_ev))},
        {"tone_map", int(scene.tone_map)},
        {"shadow_width_mm", to_json(input.shadow_width_mm)},
        {"penumbra_mm", to_json(DrawSettings{}.penumbra_mm)},
        {"lights", lights_json(scene, page.warnings)},
        {"tones", tones_json(input.tones)},
        {"tables", std::move(tables)},
        {"environment", std::move(environment)},
        {"objects", std::move(objects)}};
}

bool has_skin(const Scene& scene) {
    return std::ranges::any_of(scene.objects, [](const SceneObject& object) {
        return std::ranges::count(object.classes, MaterialClass::skin) > 0;
    });
}

}  // namespace

Result<WebPage> make_web_page(const WebInput& input) {
    if (!has_skin(input.scene)) return Error{input.scene.name + " has no skin to show"};
    if (input.scene.skin.specular_reduces_diffuse)
        return Error{input.scene.name +
                     ": skin.specular_reduces_diffuse is not drawn by the page; export with --scene "
                     "skin.specular_reduces_diffuse=false"};
    if (input.tones.empty() || input.tones.size() > kMaxTones)
        return Error{fmt::format("a page has 1 to {} skins", kMaxTones)};
    WebPage page;
    DERMIS_TRY(add_texts(input, page.files));
    Binaries binaries;
    DERMIS_TRY_ASSIGN(const json scene, scene_json(input, binaries, page));
    web::warn_of_materials(input.scene, "page", page.warnings);
    page.files.push_back({"scene.json", to_bytes(scene.dump(1) + "\n")});
    page.files.push_back({"scene.bin", binaries.scene.finish()});
    std::ranges::sort(page.files, {}, &WebFile::path);
    return page;
}

}  // namespace dermis::inline engines
