// From a description to a scene: load the meshes, place them, set their materials.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "dermis/base/angle.h"
#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/base/warnings.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/object_checks.h"
#include "dermis/scene/place_mesh.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/scene_checks.h"
#include "dermis/scene/scene_description.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_views.h"

namespace dermis::inline scene {
namespace fs = std::filesystem;
namespace {

Result<SubjectScene> load_objects(const SceneDescription& description, const MeshDescription& mesh,
                                  std::span<const Subject> subjects, Scene& scene) {
    if (const auto subject = subject_name(mesh.file.text)) {
        Result<SubjectScene> made = make_subject(subjects, *subject, mesh.parameters);
        if (!made) return error_at(description, mesh.file, made.error().message);
        return made;
    }
    DERMIS_TRY_ASSIGN(const fs::path path, resolve_file(description, mesh.file));
    Result<LoadedMesh> loaded =
        read_mesh(path, {.unit_mm = mesh.unit_mm,
                         .scale_after = mesh.scale,
                         .subdivision_level = mesh.subdivision,
                         .ignore_missing_materials = description.maps.files.contains("albedo")});
    if (!loaded) return error_at(description, mesh.file, loaded.error().message);
    scene.warnings.insert(scene.warnings.end(), loaded->warnings.begin(), loaded->warnings.end());
    scene.files.insert(scene.files.end(), loaded->files.begin(), loaded->files.end());
    SubjectScene made;
    made.objects.push_back(
        {.name = mesh.name.empty() ? path.stem().string() : mesh.name, .mesh = std::move(loaded->mesh)});
    return made;
}

void apply(const MaterialChanges& changes, Material& material) {
    for (const auto& [key, change] : changes) change(material);
}

// The sidecar that `dermis bake curvature` writes beside a map states a unit; a map without one needs its
// scale.
Result<void> check_curvature_unit(const SceneDescription& description, const MapsDescription& maps,
                                  const NamedFile& file, const fs::path& map) {
    if (maps.changes.contains("curvature_scale_per_mm")) return {};
    const Result<std::string> sidecar = read_text_file(map.string() + ".json");
    if (!sidecar)
        return error_at(description, file,
                        map.string() +
                            " has no unit; give curvature_scale_per_mm, the curvature in 1/mm of a map "
                            "value of 1, or bake the map with `dermis bake curvature`");
    const auto json = nlohmann::json::parse(*sidecar, nullptr, false);
    const auto unit = json.is_object() ? json.find("unit") : json.end();
    const bool stated = json.is_object() && unit != json.end();
    if (!stated || *unit != "1/mm")
        return error_at(description, file,
                        map.string() + ".json: the unit is " + (stated ? unit->dump() : "not stated") +
                            "; a curvature map is in \"1/mm\"");
    return {};
}

Result<void> apply_maps(const SceneDescription& description, const MapsDescription& maps,
                        Material& material) {
    for (const auto& [key, map] : maps.files) {
        DERMIS_TRY_ASSIGN(const fs::path path, resolve_file(description, map.file));
        if (key == "curvature") DERMIS_TRY(check_curvature_unit(description, maps, map.file, path));
        material.*map.to = {.name = path.string(), .encoded = {}};
    }
    // A map multiplies the constant beside it; the grey that mesh files write there is not meant as a tint.
    if (maps.files.contains("albedo")) material.base_color_linear = {1, 1, 1};
    apply(maps.changes, material);
    return {};
}

Result<void> apply_material(const SceneDescription& description, const MaterialDescription* given,
                            MaterialClass material_class, Material& material) {
    if (material_class == MaterialClass::skin) {
        apply_skin(description.skin, material);
        DERMIS_TRY(apply_maps(description, description.maps, material));
    }
    if (!given) return {};
    DERMIS_TRY(apply_maps(description, given->maps, material));
    apply(given->changes, material);
    return {};
}

// Adds the objects to the scene; returns what else a subject states.
Result<SubjectScene> add_objects(const SceneDescription& description, const MeshDescription& mesh,
                                 std::span<const Subject> subjects, Scene& scene) {
    Result<SubjectScene> made = load_objects(description, mesh, subjects, scene);
    if (!made) return made.error();
    for (SceneObject& object : made->objects) {
        place_mesh(object.mesh, {.scale = mesh.scale,
                                 .rotation_rad = mesh.rotate_deg * kRadiansPerDegree,
                                 .translation_mm = mesh.translate_mm});
        const std::vector<MaterialClass> own = std::move(object.classes);
        object.classes.clear();
        std::vector<bool> hidden;
        for (Material& material : object.mesh.materials) {
            const auto found = description.materials.find(material.name);
            const MaterialDescription* given =
                found == description.materials.end() ? nullptr : &found->second;
            // A subject states which of its materials are not skin.
            const size_t index = object.classes.size();
            const bool knows = index < own.size() && own[index] != MaterialClass::skin;
            object.classes.push_back(given && given->material_class   ? *given->material_class
                                     : knows                          ? own[index]
                                     : is_card(object.mesh, material) ? MaterialClass::other
                                                                      : mesh.default_class);
            hidden.push_back(given && !given->visible.value_or(true));
            if (const Result<void> applied =
                    apply_material(description, given, object.classes.back(), material);
                !applied)
                return applied.error();
        }
        DERMIS_TRY(apply_displacement(object.mesh));
        if (!subject_name(mesh.file.text))
            std::ranges::move(object_warnings(object), std::back_inserter(scene.warnings));
        hide_materials(object.mesh, hidden);
        scene.objects.push_back(std::move(object));
    }
    made->objects.clear();
    return made;
}

// A [material.NAME] that no mesh has is a mistake, most often in the name.
Result<void> check_material_names(const SceneDescription& description, const Scene& scene) {
    std::vector<std::string> names;
    for (const SceneObject& object : scene.objects)
        for (const Material& material : object.mesh.materials)
            if (std::ranges::find(names, material.name) == names.end()) names.push_back(material.name);
    for (const auto& [name, material] : description.materials)
        if (std::ranges::find(names, name) == names.end())
            return Error{description.file.string() + ":" + std::to_string(material.line) + ": [material." +
                         name + "]: " + unknown_name("material", name, names)};
    return {};
}

}  // namespace

bool lacks_asset(const SceneDescription& description) {
    const auto lacks = [&](const NamedFile& file) {
        return is_asset(file.text) && !resolve_path(file.text, description.file);
    };
    return std::ranges::any_of(description.meshes, lacks, &MeshDescription::file) ||
           std::ranges::any_of(description.maps.files,
                               [&](const auto& entry) { return lacks(entry.second.file); });
}

Result<Scene> build_scene(const SceneDescription& given, std::span<const Subject> subjects) {
    SceneDescription description = given;
    // A profile that is a file; one that is not there is named when the profile is read.
    if (is_profile_file(description.skin.profile))
        if (const Result<fs::path> file = resolve_path(description.skin.profile, description.file))
            description.skin.profile = file->string();
    description.skin = with_surface_of_profile(description.skin);
    const HeadDescription& head = description.head;
    Scene scene{.name = head.name.empty() ? description.file.stem().string() : head.name};
    SubjectScene stated;
    Progress progress("loading meshes", description.meshes.size());
    for (const MeshDescription& mesh : description.meshes) {
        DERMIS_TRY_ASSIGN(SubjectScene added, add_objects(description, mesh, subjects, scene));
        if (added.states_anything()) stated = std::move(added);
        progress.advance();
    }
    DERMIS_TRY(check_material_names(description, scene));

    std::ranges::move(keys_without_effect(description, scene), std::back_inserter(scene.warnings));
    compute_bounds(scene);
    DERMIS_TRY(place_views(description, scene));
    if (description.camera.line > 0) stated.camera.reset();
    if (!description.lights.empty()) stated.lights.clear();
    if (description.environment) stated.environment.reset();
    apply_statements(stated, scene);
    for (const auto& [key, path] : {std::pair{"skin.diffuse_table: ", &scene.skin.diffuse_table},
                                    std::pair{"skin.zonal_table: ", &scene.skin.zonal_table},
                                    std::pair{"skin.beckmann_table: ", &scene.skin.beckmann_table}}) {
        if (path->empty()) continue;
        const Result<fs::path> table = resolve_path(*path, description.file);
        if (!table) return Error{description.file.string() + ": " + key + table.error().message};
        *path = table->string();
    }
    if (std::string differs = surface_difference(scene.skin); !differs.empty())
        scene.warnings.push_back(std::move(differs));
    tidy_warnings(scene.warnings);  // of one file that many [[mesh]] name, for one
    scene.credit = head.credit;
    scene.technique = head.technique;
    scene.settings = description.settings;
    return scene;
}

}  // namespace dermis::inline scene
