#pragma once
// A parsed scene file as plain data: nothing is loaded yet, and every file that it names has its line.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/mesh/pose.h"
#include "dermis/scene/subject.h"

namespace dermis::inline scene {

/// A path as the file has it, and its place there; `key` is its full name ("maps.albedo").
struct NamedFile {
    std::string text, key;
    int line = 0;  ///< 0: not from a file

    [[nodiscard]] bool given() const { return !text.empty(); }
};

/// By key: what a section changes of each material that it is about.
using MaterialChanges = std::map<std::string, std::function<void(Material&)>>;

struct MapsDescription {
    struct Map {
        NamedFile file;
        ImageSource Material::*to = nullptr;
    };
    std::map<std::string, Map> files;  ///< by key
    MaterialChanges changes;
};

struct MaterialDescription {
    int line = 0;
    std::optional<HeadPart> part;
    std::optional<bool> visible;
    MaterialChanges changes;
    MapsDescription maps;
};

struct MeshDescription {
    int line = 0;
    NamedFile file;
    std::string name;
    std::optional<float> unit_mm;
    float scale = 1;
    Vec3 rotate_deg, translate_mm;
    int subdivision = 0;
    std::optional<HeadPart> default_part;           ///< of materials without one; none: find_parts()
    std::map<std::string, std::string> parameters;  ///< of the subject that `file` names, as text
};

/// Either a position, or a yaw and pitch (and a distance, unless directional) around a target.
struct LightDescription {
    int line = 0;
    std::string name;
    LightKind kind = LightKind::directional;
    Vec3 color_linear = {1, 1, 1};
    float intensity = 3.14159265f;
    std::optional<float> yaw_deg, pitch_deg, distance_mm;
    std::optional<Vec3> position_mm, target_mm;
    float inner_angle_deg = 20, outer_angle_deg = 28;
    std::optional<bool> key;
    bool shadow = true;
};

/// Either an eye, or a yaw, pitch and distance around a target; what is missing frames the scene.
struct CameraDescription {
    int line = 0;
    std::optional<Vec3> eye_mm, target_mm;
    std::optional<float> yaw_deg, pitch_deg, distance_mm;
    float fov_deg = 30;
};

struct EnvironmentDescription {
    int line = 0;
    std::optional<EnvironmentKind> kind;
    NamedFile file;
    float intensity = 1, yaw_deg = 0;
    bool visible = false;
};

/// Largest weight of a morph target, either way.
inline constexpr double kMostMorph = 100;

/// Keys outside any section.
struct HeadDescription {
    std::string name, credit, technique;
    std::string without_assets;  ///< the scene to draw where files of this one are missing
    Vec3 background_linear = {0.02f, 0.02f, 0.022f};
    ToneMap tone_map = ToneMap::hable;
    float exposure_ev = 0;
    int shadow_maps = 3;
};

struct SceneDescription {
    std::filesystem::path file;  ///< for messages and relative paths
    bool is_bare_mesh = false;   ///< a mesh file was named, no scene file: unit and profile are taken from it
    HeadDescription head;
    std::vector<MeshDescription> meshes;
    MapsDescription maps;
    std::map<std::string, MaterialDescription> materials;  ///< by the mesh's material names
    Skin skin;
    std::map<std::string, NamedFile> blood_by_target;  ///< of the skin
    MotionDescription motion;
    std::vector<LightDescription> lights;
    std::optional<EnvironmentDescription> environment;
    CameraDescription camera;
    std::map<std::string, std::string> settings;
};

/// Largest scene file, in bytes.
inline constexpr size_t kMaxSceneBytes = size_t{1} << 20;

/// TOML text; no file is touched. Errors are "FILE:LINE: ..." and name the key and what would be right:
/// syntax, unknown keys and sections, wrong types, values out of range, keys that exclude one another, no
/// mesh, not exactly one key light. `subjects` are those whose parameters a [[mesh]] may have.
[[nodiscard]] Result<SceneDescription> parse_scene(std::string_view toml, const std::filesystem::path& file,
                                                   std::span<const Subject> subjects);

/// Loads everything the description names. Errors name the line that named the file.
[[nodiscard]] Result<Scene> build_scene(const SceneDescription& description,
                                        std::span<const Subject> subjects);

/// Whether a mesh or a map of [maps] is an asset that is in none of the directories.
[[nodiscard]] bool lacks_asset(const SceneDescription& description);

/// Every key of the scene file as tables in Markdown, from the rows that parse it.
[[nodiscard]] std::string scene_file_manual(std::span<const Subject> subjects);

}  // namespace dermis::inline scene
