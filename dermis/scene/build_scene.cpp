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
#include "dermis/scene/blood_tint.h"
#include "dermis/scene/corneas.h"
#include "dermis/scene/find_parts.h"
#include "dermis/scene/object_checks.h"
#include "dermis/scene/place_mesh.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/pose_scene.h"
#include "dermis/scene/rest_bakes.h"
#include "dermis/scene/scene_checks.h"
#include "dermis/scene/scene_description.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_views.h"
#include "dermis/scene/skin_pigments.h"
#include "dermis/scene/skin_profiles.h"
#include "dermis/scene/skin_tone.h"
#include "dermis/scene/wrinkles.h"

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
    const MeshOptions options = {.unit_mm = mesh.unit_mm,
                                 .scale_after = mesh.scale,
                                 .guess_unit = description.is_bare_mesh,
                                 .subdivision_level = mesh.subdivision,
                                 .ignore_missing_materials = description.maps.files.contains("albedo"),
                                 .pose = description.motion.pose()};
    Result<LoadedMesh> loaded = read_mesh(path, options);
    if (loaded) DERMIS_TRY(add_rest_positions(path, options, *loaded));
    if (!loaded) return error_at(description, mesh.file, loaded.error().message);
    scene.warnings.insert(scene.warnings.end(), loaded->warnings.begin(), loaded->warnings.end());
    scene.files.insert(scene.files.end(), loaded->files.begin(), loaded->files.end());
    SubjectScene made;
    made.objects.push_back({.name = mesh.name.empty() ? path.stem().string() : mesh.name,
                            .mesh = std::move(loaded->mesh),
                            .unit_mm = loaded->unit_mm,
                            .motion = std::move(loaded->motion),
                            .target_weights = std::move(loaded->target_weights),
                            .file = path,
                            .subdivision = mesh.subdivision});
    return made;
}

// The maps of the skin, at the vertices.
Result<void> load_blood_by_target(const SceneDescription& description, Scene& scene) {
    for (const auto& [target, file] : description.blood_by_target) {
        DERMIS_TRY_ASSIGN(const fs::path path, resolve_file(description, file));
        if (Result<void> added = add_blood_by_target(target, path, scene); !added)
            return error_at(description, file, added.error().message);
        scene.skin.blood_by_target[target] = path.string();
    }
    return {};
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
        if (!description.is_bare_mesh || !material.scattering) apply_skin(description.skin, material);
        DERMIS_TRY(apply_maps(description, description.maps, material));
    }
    if (!given) return {};
    DERMIS_TRY(apply_maps(description, given->maps, material));
    apply(given->changes, material);
    return {};
}

// The parts of a mesh file's materials: those that the scene states, then those that are found.
std::vector<FoundPart> parts_of(const SceneDescription& description, const MeshDescription& given,
                                const Mesh& mesh) {
    std::vector<FoundPart> parts = find_parts(mesh);
    for (size_t i = 0; i < parts.size(); ++i) {
        const auto material = description.materials.find(mesh.materials[i].name);
        if (material != description.materials.end() && material->second.part)
            parts[i] = {*material->second.part, "the scene's class"};
        else if (given.default_part && !is_card(mesh, mesh.materials[i]))
            parts[i] = {*given.default_part, "the scene's default_class"};
        else if (given.default_part)
            parts[i] = {HeadPart::other, "alpha cuts it out"};
    }
    return parts;
}

// A subject states which of its materials are not skin.
std::vector<MaterialClass> classes_of_subject(const SceneDescription& description,
                                              const MeshDescription& mesh, const SceneObject& object) {
    std::vector<MaterialClass> classes;
    for (size_t i = 0; i < object.mesh.materials.size(); ++i) {
        const auto given = description.materials.find(object.mesh.materials[i].name);
        if (given != description.materials.end() && given->second.part)
            classes.push_back(class_of(*given->second.part));
        else if (i < object.classes.size() && object.classes[i] != MaterialClass::skin)
            classes.push_back(object.classes[i]);
        else
            classes.push_back(class_of(mesh.default_part.value_or(HeadPart::skin)));
    }
    return classes;
}

// Skin without a colour takes that of the tone or of the profile, so that both belong to one skin.
void complete_skin_color(const SceneDescription& description, const SceneObject& object, Material& material) {
    if (!has_skin_color(material) && object.mesh.colors_linear.empty())
        material.base_color_linear = usual_skin_albedo(description.skin);
}

Result<void> set_up_materials(const SceneDescription& description, const MeshDescription& mesh,
                              SceneObject& object, Scene& scene) {
    const bool is_file = !subject_name(mesh.file.text);
    if (is_file) {
        object.parts = parts_of(description, mesh, object.mesh);
        // At rest, so that the cut is the same in every pose.
        std::vector<Vec3>& rest_mm = object.mesh.rest_positions_mm;
        const bool is_posed = !rest_mm.empty();
        if (is_posed) std::swap(object.mesh.positions_mm, rest_mm);
        cut_out_corneas(object.mesh, object.parts);
        if (is_posed) std::swap(object.mesh.positions_mm, rest_mm);
        object.classes.clear();
        for (const FoundPart& found : object.parts) object.classes.push_back(class_of(found.part));
        if (const std::string note = parts_note(object); !note.empty() && is_guessed(object.parts))
            scene.warnings.push_back(note);
    } else {
        object.classes = classes_of_subject(description, mesh, object);
    }
    for (size_t i = 0; i < object.mesh.materials.size(); ++i) {
        Material& material = object.mesh.materials[i];
        const auto found = description.materials.find(material.name);
        if (is_file) complete_material(object.parts[i], material);
        if (is_file && object.classes[i] == MaterialClass::skin)
            complete_skin_color(description, object, material);
        DERMIS_TRY(apply_material(description,
                                  found == description.materials.end() ? nullptr : &found->second,
                                  object.classes[i], material));
        if (const Result<void> checked = check_wrinkles(material); !checked)
            return description.file.empty() ? checked.error()
                                            : checked.error().within(description.file.string());
    }
    return {};
}

// Shells that are left out and materials that the scene makes invisible.
std::vector<bool> hidden_materials(const SceneDescription& description, const SceneObject& object) {
    std::vector<bool> hidden;
    for (size_t i = 0; i < object.mesh.materials.size(); ++i) {
        const auto given = description.materials.find(object.mesh.materials[i].name);
        const bool left_out = i < object.parts.size() && object.parts[i].left_out;
        const bool is_given = given != description.materials.end();
        hidden.push_back(is_given && given->second.visible ? !*given->second.visible : left_out);
    }
    return hidden;
}

// Adds the objects to the scene; returns what else a subject states.
Result<SubjectScene> add_objects(const SceneDescription& description, const MeshDescription& mesh,
                                 std::span<const Subject> subjects, Scene& scene) {
    Result<SubjectScene> made = load_objects(description, mesh, subjects, scene);
    if (!made) return made.error();
    for (SceneObject& object : made->objects) {
        pose_subject(object, description.motion.pose());
        object.placement = {.scale = mesh.scale,
                            .rotation_rad = mesh.rotate_deg * kRadiansPerDegree,
                            .translation_mm = mesh.translate_mm};
        place_mesh(object.mesh, object.placement);
        if (!object.posed_vertices) measure_tension(object.mesh);
        DERMIS_TRY(set_up_materials(description, mesh, object, scene));
        DERMIS_TRY(apply_displacement(object.mesh));
        if (!subject_name(mesh.file.text))
            std::ranges::move(object_warnings(object), std::back_inserter(scene.warnings));
        object.hidden = hidden_materials(description, object);
        hide_materials(object.mesh, object.hidden);
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

// The same objects in the rest pose.
Result<void> add_rest_pose(const SceneDescription& given, std::span<const Subject> subjects, Scene& scene) {
    const std::string place = given.file.empty() ? "" : given.file.string() + ": ";
    const Result<RestBakes> bakes = parse_rest_bakes(given.motion);
    if (!bakes) return Error{place + bakes.error().message};
    if (!bakes->any()) return {};
    SceneDescription rest = given;
    rest.motion = {};
    // A guessed unit must not depend on the pose.
    for (size_t i = 0; rest.meshes.size() == scene.objects.size() && i < rest.meshes.size(); ++i)
        if (!subject_name(rest.meshes[i].file.text)) rest.meshes[i].unit_mm = float(scene.objects[i].unit_mm);
    Result<Scene> built = build_scene(rest, subjects);
    if (!built) return built.error();
    scene.rest_objects = std::move(built->objects);
    scene.rest_bakes = *bakes;
    const Result<void> checked = check_rest_objects(scene);
    return checked ? checked : Error{place + checked.error().message};
}

// The profile of a mesh whose skin states one, unless a word chose another; what the file has and a profile
// has not is named.
void take_profile_of_mesh(const SceneDescription& description, Scene& scene) {
    const auto scatters = [](const Material& material) { return material.scattering.has_value(); };
    const bool states = std::ranges::any_of(scene.objects, [&](const SceneObject& object) {
        return std::ranges::any_of(object.mesh.materials, scatters);
    });
    if (!states || scene.skin.profile != Skin{}.profile) return;
    const std::string& path = description.meshes.front().file.text;
    const Result<Profile> profile = find_profile(path);
    if (!profile)
        return scene.warnings.push_back(profile.error().message + "; skin.profile stays " +
                                        scene.skin.profile);
    scene.skin.profile = path;
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
    description.skin =
        with_profile_of_tone(with_profile_of_pigments(with_surface_of_profile(description.skin)));
    const HeadDescription& head = description.head;
    Scene scene{.name = head.name.empty() ? description.file.stem().string() : head.name};
    SubjectScene stated;
    Progress progress("loading meshes", description.meshes.size());
    for (const MeshDescription& mesh : description.meshes) {
        DERMIS_TRY_ASSIGN(SubjectScene added, add_objects(description, mesh, subjects, scene));
        if (added.states_anything()) stated = std::move(added);
        progress.advance();
    }
    if (const Result<void> checked = check_motion(scene.objects, description.motion); !checked)
        return description.file.empty() ? checked.error() : checked.error().within(description.file.string());
    if (const Result<void> checked = check_wrinkle_targets(scene); !checked)
        return description.file.empty() ? checked.error() : checked.error().within(description.file.string());
    DERMIS_TRY(check_material_names(description, scene));
    DERMIS_TRY(resolve_profiles(scene, description.file));

    if (!description.is_bare_mesh)
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
    if (description.is_bare_mesh) take_profile_of_mesh(description, scene);
    DERMIS_TRY(load_blood_by_target(description, scene));
    DERMIS_TRY(apply_pigment_maps(scene));
    DERMIS_TRY(apply_pigments(scene));
    DERMIS_TRY(apply_tone(scene));
    if (const Result<void> tinted = apply_moving_blood(scene); !tinted)
        return description.file.empty() ? tinted.error() : tinted.error().within(description.file.string());
    std::ranges::move(skin_warnings(scene), std::back_inserter(scene.warnings));
    std::ranges::move(tension_warnings(scene), std::back_inserter(scene.warnings));
    tidy_warnings(scene.warnings);  // of one file that many [[mesh]] name, for one
    scene.motion = description.motion;
    scene.credit = head.credit;
    scene.technique = head.technique;
    scene.settings = description.settings;
    DERMIS_TRY(add_rest_pose(given, subjects, scene));
    return scene;
}

}  // namespace dermis::inline scene
