#include "dermis/scene/load_scene.h"

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/pose_scene.h"
#include "dermis/scene/scene_checks.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_words.h"

namespace dermis::inline scene {
namespace fs = std::filesystem;
namespace {

Result<Scene> load_subject(const std::string& path_or_name, std::string_view name,
                           const SceneOptions& options) {
    DERMIS_TRY_ASSIGN(SubjectScene made, make_subject(options.subjects, name));
    SceneDescription posed;
    for (const SceneWord& word : options.words)
        if (is_motion_key(word.key)) DERMIS_TRY(set_word(posed, word, options.subjects));
    if (const Result<void> checked = check_motion(made.objects, posed.motion); !checked)
        return checked.error().within(path_or_name);
    DERMIS_TRY_ASSIGN(const RestBakes rest_bakes, parse_rest_bakes(posed.motion));
    Scene scene = scene_of(std::string(name), std::move(made));
    scene.motion = posed.motion;
    scene.rest_bakes = rest_bakes;
    if (rest_bakes.any()) scene.rest_objects = scene.objects;
    for (SceneObject& object : scene.objects) pose_subject(object, posed.motion.pose());
    compute_bounds(scene);
    return scene;
}

Result<SceneDescription> read_description(const fs::path& path, const SceneOptions& options) {
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(path));
    Result<SceneDescription> description = parse_scene(text, path, options.subjects);
    if (!description || options.words.empty()) return description;
    for (const SceneWord& word : options.words) DERMIS_TRY(set_word(*description, word, options.subjects));
    DERMIS_TRY(check_scene(*description));
    return description;
}

// Only a scene file has these keys; an unknown one is reported as such first.
Result<void> refuse_words(const std::string& name, const SceneOptions& options) {
    const auto needs_file = [](const std::string& key) { return is_loading_key(key) && !is_motion_key(key); };
    const auto word = std::ranges::find_if(options.words, needs_file, &SceneWord::key);
    if (word == options.words.end()) return {};
    SceneDescription any{.meshes = {{.file = {.text = name}}}};
    if (Result<void> set = set_word(any, *word, options.subjects); !set) return set;
    return Error{word->key + ": cannot be changed for " + name +
                 "; write a scene file with [[mesh]] file = \"" + name + "\""};
}

Result<Scene> load_scene_file(const fs::path& path, const SceneOptions& options) {
    DERMIS_TRY_ASSIGN(const SceneDescription description, read_description(path, options));
    Result<Scene> scene = build_scene(description, options.subjects);
    if (scene) scene->files.push_back(path);
    if (scene || description.head.without_assets.empty() || !lacks_asset(description)) return scene;

    const Result<SceneDescription> other =
        read_description(path.parent_path() / (description.head.without_assets + ".toml"), options);
    Result<Scene> instead = other ? build_scene(*other, options.subjects) : other.error();
    if (!instead) return scene;
    instead->files.push_back(path);
    instead->warnings.insert(instead->warnings.begin(), scene.error().message + "; drawing scene '" +
                                                            description.head.without_assets + "' instead");
    return instead;
}

void warn_of_color(const fs::path& path, Scene& scene) {
    const auto has_color = [](const SceneObject& object) {
        return !object.mesh.colors_linear.empty() ||
               std::ranges::any_of(object.mesh.materials,
                                   [](const Material& m) { return m.base_color_map.present(); });
    };
    if (std::ranges::none_of(scene.objects, has_color))
        scene.warnings.push_back(path.string() +
                                 ": no map of colour, so the skin has one colour; name a map with --scene "
                                 "maps.albedo=FILE or in a scene file (docs/scene_file.md)");
}

// A mesh file is a scene with that mesh and all defaults.
Result<Scene> load_mesh_file(const fs::path& path, const SceneOptions& options) {
    if (std::error_code ec; !fs::exists(path, ec))
        return Error{path.string() + ": cannot open: No such file or directory"};
    SceneDescription description{.is_bare_mesh = true};
    description.head.name = path.stem().string();
    description.head.exposure_ev = 0.6f;
    MeshDescription& mesh = description.meshes.emplace_back();
    mesh.file = {.text = path.string(), .key = "mesh.file"};
    mesh.unit_mm = options.mesh_unit_mm;
    for (const SceneWord& word : options.words) DERMIS_TRY(set_word(description, word, options.subjects));
    DERMIS_TRY(check_scene(description));
    DERMIS_TRY_ASSIGN(Scene scene, build_scene(description, options.subjects));
    warn_of_color(path, scene);
    return scene;
}

bool looks_like_a_name(std::string_view text) {
    return text.find('/') == std::string_view::npos && text.find('.') == std::string_view::npos;
}

}  // namespace

Result<Scene> load_scene(const std::string& path_or_name, const SceneOptions& options) {
    const bool is_mesh = is_mesh_file(path_or_name);
    const auto subject = subject_name(path_or_name);
    if (subject) DERMIS_TRY(refuse_words(path_or_name, options));
    if (subject) return load_subject(path_or_name, *subject, options);
    const fs::path path = path_or_name;
    std::error_code ec;
    if (looks_like_a_name(path_or_name) && !fs::is_regular_file(path, ec)) {
        if (const fs::path file = find_scene(path_or_name); !file.empty())
            return load_scene_file(file, options);
        return Error{unknown_name("scene", path_or_name, scene_names()) +
                     ", or a .toml, .obj, .gltf or .glb file"};
    }
    if (is_mesh) return load_mesh_file(path, options);
    if (to_lower(path.extension().string()) == ".toml") return load_scene_file(path, options);
    return Error{path_or_name + ": neither a scene (.toml) nor a mesh (.obj, .gltf, .glb)"};
}

}  // namespace dermis::inline scene
