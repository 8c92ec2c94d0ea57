#include "dermis/scene/scene_words.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "dermis/optics/presets.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/scene_checks.h"
#include "dermis/scene/scene_views.h"
#include "dermis/scene/skin_tone.h"
#include "dermis/scene/toml_values.h"

namespace dermis::inline scene {
namespace {

constexpr std::string_view kSections[] = {"mesh",  "maps",  "material",    "skin",   "animation",
                                          "morph", "light", "environment", "camera", "settings"};

// "light.key.intensity": the section, the name of one of its tables, and the key. Names of lights and
// materials may contain dots.
struct Address {
    std::string section, which, key;

    explicit Address(std::string_view text) {
        const size_t first = text.find('.'), last = text.rfind('.');
        key = text.substr(last == text.npos ? 0 : last + 1);
        if (first == text.npos) return;
        section = text.substr(0, first);
        if (first < last) which = text.substr(first + 1, last - first - 1);
    }
};

// A word's value as the TOML type of its key, so that the checks of the file apply to it.
TomlNode word_node(std::string_view text, const KeyInfo& info) {
    TomlNode node{.kind = TomlKind::string, .text = std::string(text)};
    if (info.kind == KeyKind::file && text.find(':') == text.npos && !text.empty())
        node.text = std::filesystem::absolute(node.text).lexically_normal().string();
    if (info.kind == KeyKind::text || info.kind == KeyKind::file || info.kind == KeyKind::choice) return node;
    if (text == "true" || text == "false") return {.kind = TomlKind::boolean, .flag = text == "true"};
    if (const auto number = parse_number(text)) {
        const bool whole = std::abs(*number) < 1e9 && *number == std::floor(*number);
        return {.kind = whole ? TomlKind::integer : TomlKind::number,
                .number = *number,
                .integer = whole ? int64_t(*number) : 0};
    }
    if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
    if (text.find(',') == text.npos) return node;
    TomlNode array{.kind = TomlKind::array};
    for (const std::string_view part : split(text, ',')) array.items.push_back(word_node(trim(part), info));
    return array;
}

template <class Target>
Result<void> set(const KeyTable<Target>& table, Target& target, const std::string& path,
                 const std::string& key, const std::string& value) {
    TomlNode node;
    return set_key(table, target, path, key, {},
                   [&](const KeyInfo& info) -> const TomlNode& { return node = word_node(value, info); });
}

// The table of an array of tables that `which` chooses.
template <class Target>
Result<Target*> choose(std::vector<Target>& targets, const Address& address) {
    if (address.which.empty() && targets.size() == 1) return &targets[0];
    std::vector<std::string> names;
    for (size_t i = 0; i < targets.size(); ++i) {
        Target& target = targets[i];
        bool chosen =
            address.which == std::to_string(i + 1) || (!target.name.empty() && target.name == address.which);
        if constexpr (requires { target.key; })
            chosen |= address.which == "key" && target.key.value_or(false);
        if (chosen) return &target;
        names.push_back(target.name.empty() ? std::to_string(i + 1) : target.name);
    }
    if (!address.which.empty()) return Error{unknown_name(address.section, address.which, names)};
    return Error{address.section + "." + address.key + ": the scene has " + std::to_string(targets.size()) +
                 "; say which, such as " + address.section + "." + (names.empty() ? "1" : names[0]) + "." +
                 address.key};
}

Result<void> set_mesh(SceneDescription& scene, const Address& address, const std::string& text,
                      std::span<const Subject> subjects) {
    DERMIS_TRY_ASSIGN(MeshDescription* const mesh, choose(scene.meshes, address));
    TomlNode node;
    return set_mesh_key(*mesh, address.key, subjects, {},
                        [&](const KeyInfo& info) -> const TomlNode& { return node = word_node(text, info); });
}

Result<void> set_material(SceneDescription& scene, const Address& address, const std::string& value) {
    std::string name = address.which;
    const bool is_map = name.ends_with(".maps");
    if (is_map) name.resize(name.size() - 5);
    if (name.empty()) return Error{"material." + address.key + ": write material.NAME." + address.key};
    const std::string path = "material." + address.which;
    MaterialDescription& material = scene.materials[name];
    return is_map ? set(maps_keys(), material.maps, path, address.key, value)
                  : set(material_keys(), material, path, address.key, value);
}

Result<KeyValue> value_of(const SceneWord& word, const KeyInfo& info) {
    KeyValue value;
    if (!read_toml_value(word_node(word.value, info), info, value))
        return Error{word.key + " = " + word.value.substr(0, 40) + ": " + info.name + " " +
                     wanted_text(info)};
    return value;
}

// The target of a word whose table has a key for each target. Names of targets may contain dots.
std::optional<std::string> target_of(std::string_view key, std::string_view table) {
    if (!key.starts_with(table) || key.size() <= table.size() + 1 || key[table.size()] != '.') return {};
    return std::string(key.substr(table.size() + 1));
}

Result<void> set_morph(MotionDescription& motion, const SceneWord& word) {
    const auto target = target_of(word.key, "morph");
    if (!target) return Error{"morph: write morph.TARGET=WEIGHT, such as morph.jawOpen=0.6"};
    DERMIS_TRY_ASSIGN(const KeyValue value, value_of(word, morph_key(*target)));
    motion.morph[*target] = float(value.numbers[0]);
    return {};
}

Result<void> set_environment(SceneDescription& scene, const Address& address, const std::string& value) {
    if (!scene.environment) scene.environment.emplace();
    EnvironmentDescription& environment = *scene.environment;
    if (Result<void> done = set(environment_keys(), environment, "environment", address.key, value); !done)
        return done;
    if (address.key == "file") environment.kind = EnvironmentKind::file;
    if (address.key == "kind" && environment.kind != EnvironmentKind::file) environment.file = {};
    return {};
}

Result<void> set_camera(CameraDescription& camera, const Address& address, const std::string& value) {
    Result<void> done = set(camera_keys(), camera, "camera", address.key, value);
    if (done && address.key == "eye_mm") camera.yaw_deg = camera.pitch_deg = camera.distance_mm = {};
    return done;
}

Result<void> set_light(SceneDescription& scene, const Address& address, const std::string& value) {
    const Result<LightDescription*> light = choose(scene.lights, address);
    if (!light) return light.error();
    Result<void> done = set(light_keys(), **light, "light", address.key, value);
    if (done && address.key == "position_mm")
        (*light)->yaw_deg = (*light)->pitch_deg = (*light)->distance_mm = {};
    return done;
}

// The row of a key of [[mesh]], [maps], [material.NAME], [material.NAME.maps], [skin] or the root.
const KeyInfo* info_of(const Address& address) {
    const auto in = [&](const auto& table) -> const KeyInfo* {
        const auto* row = table.find(address.key);
        return row ? &row->info : nullptr;
    };
    if (address.section.empty()) return in(head_keys());
    if (address.section == "mesh") return in(mesh_keys());
    if (address.section == "skin") return in(skin_keys());
    if (address.section == "maps" || address.which.ends_with(".maps")) return in(maps_keys());
    return address.section == "material" ? in(material_keys()) : nullptr;
}

std::string table_of(const Address& address) {
    if (address.section != "material") return address.section;
    constexpr std::string_view kMaps = ".maps";
    const bool is_map = address.which.ends_with(kMaps);
    const std::string name = address.which.substr(0, address.which.size() - (is_map ? kMaps.size() : 0));
    return "material." + toml_key(name) + (is_map ? ".maps" : "");
}

template <class Value>
void keep_equal(const Value& before, Value& after, const Value& value) {
    if (before == after) after = value;
}

// Takes what differs between two scenes made from descriptions. Directions and angles that do not differ stay
// bit-equal: converted to degrees and back, a camera would move.
void take_changes(const Scene& before, Scene after, Scene& scene) {
    keep_equal(before.camera.eye_mm, after.camera.eye_mm, scene.camera.eye_mm);
    keep_equal(before.camera.target_mm, after.camera.target_mm, scene.camera.target_mm);
    keep_equal(before.camera.vertical_fov_rad, after.camera.vertical_fov_rad, scene.camera.vertical_fov_rad);
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light &old = before.lights[i], &kept = scene.lights[i];
        Light& light = after.lights[i];
        keep_equal(old.to_light_world, light.to_light_world, kept.to_light_world);
        keep_equal(old.position_mm, light.position_mm, kept.position_mm);
        keep_equal(old.inner_angle_rad, light.inner_angle_rad, kept.inner_angle_rad);
        keep_equal(old.outer_angle_rad, light.outer_angle_rad, kept.outer_angle_rad);
    }
    scene.camera.eye_mm = after.camera.eye_mm;
    scene.camera.target_mm = after.camera.target_mm;
    scene.camera.vertical_fov_rad = after.camera.vertical_fov_rad;
    scene.lights = std::move(after.lights);
    scene.skin = after.skin;
    scene.background_linear = after.background_linear;
    scene.tone_map = after.tone_map;
    scene.exposure_ev = after.exposure_ev;
    scene.shadow_map_budget = after.shadow_map_budget;
}

}  // namespace

Result<SceneWord> parse_scene_word(std::string_view text) {
    const size_t equals = text.find('=');
    if (equals == text.npos || equals == 0)
        return Error{"'" + std::string(text) + "' is no KEY=VALUE, such as environment.yaw_deg=30"};
    return SceneWord{std::string(trim(text.substr(0, equals))), std::string(trim(text.substr(equals + 1)))};
}

Result<std::vector<SceneWord>> parse_section_words(std::string_view section, std::string_view text) {
    std::vector<SceneWord> words;
    for (const std::string_view part : split(text, ' ')) {
        if (trim(part).empty()) continue;
        Result<SceneWord> word = parse_scene_word(trim(part));
        if (!word)
            return Error{std::string(section) + ": '" + std::string(part) +
                         "' is no KEY=VALUE, such as yaw_deg=30"};
        word->key = std::string(section) + "." + word->key;
        words.push_back(std::move(*word));
    }
    return words;
}

Result<void> set_word(SceneDescription& scene, const SceneWord& word, std::span<const Subject> subjects) {
    const Address address(word.key);
    if (address.section == "mesh") return set_mesh(scene, address, word.value, subjects);
    if (address.section == "light") return set_light(scene, address, word.value);
    if (address.section == "material") return set_material(scene, address, word.value);
    if (address.section == "morph") return set_morph(scene.motion, word);
    if (const auto target = target_of(word.key, kBloodByTarget)) {
        DERMIS_TRY_ASSIGN(const KeyValue value, value_of(word, blood_map_key(*target)));
        scene.blood_by_target[*target] = blood_map_of(*target, value);
        return {};
    }
    if (!address.which.empty() && std::ranges::count(kSections, address.section))
        return Error{word.key + ": [" + address.section + "] has no tables; write " + address.section + "." +
                     address.key};
    if (address.section.empty()) return set(head_keys(), scene.head, "", address.key, word.value);
    if (address.section == "maps") return set(maps_keys(), scene.maps, "maps", address.key, word.value);
    if (address.section == "skin") return set(skin_keys(), scene.skin, "skin", address.key, word.value);
    if (address.section == "animation")
        return set(animation_keys(), scene.motion, "animation", address.key, word.value);
    if (address.section == "environment") return set_environment(scene, address, word.value);
    if (address.section == "camera") return set_camera(scene.camera, address, word.value);
    if (address.section == "settings") {
        scene.settings[address.key] = word.value;
        return {};
    }
    return Error{unknown_name("section", address.section,
                              std::vector<std::string>(std::begin(kSections), std::end(kSections)))};
}

Result<FileKey> file_key(const SceneWord& word) {
    if (const auto target = target_of(word.key, kBloodByTarget)) {
        const KeyInfo info = blood_map_key(*target);
        DERMIS_TRY_ASSIGN(const KeyValue value, value_of(word, info));
        return FileKey{kBloodByTarget, "", toml_key(*target), toml_value(info, value)};
    }
    const Address address(word.key);
    const KeyInfo* info = info_of(address);
    if (!info) return Error{word.key + ": no key of a mesh, a material, the maps or the skin"};
    DERMIS_TRY_ASSIGN(const KeyValue value, value_of(word, *info));
    return FileKey{.table = table_of(address),
                   .which = address.section == "mesh" ? address.which : "",
                   .key = address.key,
                   .value = toml_value(*info, value)};
}

bool is_loading_key(std::string_view key) {
    const Address address(key);
    const auto loads = [&](const auto& table) {
        const auto* row = table.find(address.key);
        return !row || !row->info.changeable;
    };
    if (address.section.empty()) return loads(head_keys());
    if (address.section == "skin") return loads(skin_keys());
    return address.section != "light" && address.section != "environment" && address.section != "camera";
}

bool is_motion_key(std::string_view key) {
    return key.starts_with("animation.") || key.starts_with("morph.");
}

Result<void> set_words(Scene& scene, std::span<const SceneWord> words) {
    if (words.empty()) return {};
    SceneDescription before = describe(scene), after = before;
    bool environment = false, camera = false;
    for (const SceneWord& word : words) {
        if (is_loading_key(word.key))
            return Error{word.key + ": read while the scene is loaded; give it with --scene to the command"};
        if (Result<void> set = set_word(after, word, {}); !set) return set;
        environment |= word.key.starts_with("environment.");
        camera |= word.key.starts_with("camera.");
    }
    if (Result<void> checked = check_views(after); !checked) return checked;
    if (const auto known = find_profile(after.skin.profile); !known)
        return Error{"skin.profile: " + known.error().message};
    // The panorama is read again only if a word changed it: its file may have been removed.
    const bool turned = after.environment->yaw_deg != before.environment->yaw_deg;
    before.environment.reset();
    if (!environment) after.environment.reset();
    Scene old{.bounds_center_mm = scene.bounds_center_mm, .bounds_radius_mm = scene.bounds_radius_mm};
    Scene fresh = old;
    if (Result<void> placed = place_views(before, old); !placed) return placed;
    if (Result<void> placed = place_views(after, fresh); !placed) return placed;
    if (environment) {
        if (!turned) fresh.environment.yaw_rad = scene.environment.yaw_rad;
        scene.environment = fresh.environment;
    }
    const bool other_profile = fresh.skin.profile != scene.skin.profile;
    take_changes(old, fresh, scene);
    if (other_profile) std::ranges::move(skin_warnings(scene), std::back_inserter(scene.warnings));
    if (camera) fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    return {};
}

Result<void> set_section(Scene& scene, std::string_view section, std::string_view text) {
    const Result<std::vector<SceneWord>> words = parse_section_words(section, text);
    return words ? set_words(scene, *words) : words.error();
}

}  // namespace dermis::inline scene
