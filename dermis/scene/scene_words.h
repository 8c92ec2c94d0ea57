#pragma once
// Keys of the scene file outside of a file, as --scene, --camera and --light take them and as the viewer
// copies them:
//
//     exposure_ev=0.5  skin.profile=jensen_skin1  environment.file=sunset.hdr  camera.target_mm=0,5,60
//     light.key.intensity=2  light.2.color=1,.9,.8  mesh.tone=5  material.eyes.roughness=0.1
//
// A [[light]] or [[mesh]] is chosen by its name, by its number from 1, and the key light as `key`; a single
// one needs none of these. Strings need no quotes. Paths are relative to the current directory.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/scene/scene_keys.h"

namespace dermis::inline scene {

/// "KEY=VALUE". Errors: it has no '='.
[[nodiscard]] Result<SceneWord> parse_scene_word(std::string_view text);
/// Words of one section, between spaces: "yaw_deg=30 pitch_deg=5" of "camera" or "light.key".
[[nodiscard]] Result<std::vector<SceneWord>> parse_section_words(std::string_view section,
                                                                 std::string_view text);

/// Sets one key, by the same tables and with the same errors as a line of the file. What the key excludes
/// goes: `environment.file` replaces another kind.
[[nodiscard]] Result<void> set_word(SceneDescription& scene, const SceneWord& word,
                                    std::span<const Subject> subjects);

/// Whether a key is read while a scene is loaded (all of meshes, maps, materials and settings, some of the
/// root and of [skin]); set_words() takes the others.
[[nodiscard]] bool is_loading_key(std::string_view key);

/// Whether it is a key of [animation] or [morph].
[[nodiscard]] bool is_motion_key(std::string_view key);

/// The place of a word in a scene file, and its value as TOML. `table`: as a header has it,
/// `material."M Lips".maps`. `which`: the [[mesh]] or [[light]] by its name or its number from 1; may be
/// empty.
struct FileKey {
    std::string table, which, key, value;
};
/// Errors: no such key, a value that the key does not take.
[[nodiscard]] Result<FileKey> file_key(const SceneWord& word);

/// Changes a loaded scene. What no word names keeps its bits; after an error nothing has changed. Errors:
/// those of set_word() and of the file's checks, a key that is_loading_key(), an unknown profile, a panorama
/// that is not there.
[[nodiscard]] Result<void> set_words(Scene& scene, std::span<const SceneWord> words);
/// The same of one section's words: set_section(scene, "camera", "yaw_deg=30 pitch_deg=5").
[[nodiscard]] Result<void> set_section(Scene& scene, std::string_view section, std::string_view text);

/// A key of a loaded scene and its value, out of the tables.
struct SceneKey {
    std::string section;  ///< "" of the root
    int light = 0;        ///< which of the lights, from 0
    const KeyInfo* info = nullptr;
    KeyValue value;
};
/// All that set_words() could set, in the order of the tables. Angles and distances of cameras and lights are
/// without the digits that float positions cannot hold, so the words of a scene stay when they are set.
[[nodiscard]] std::vector<SceneKey> keys_of(const Scene& scene);
/// The same as words, numbers rounded to 1e-4; the key light is `light.key`, the others have numbers.
[[nodiscard]] std::vector<SceneWord> words_of(const Scene& scene);

/// Values as words have them ("1,0.9,0.8") and as TOML has them ("[1, 0.9, 0.8]"), rounded to 1e-4.
[[nodiscard]] std::string word_text(const KeyInfo& info, const KeyValue& value);
[[nodiscard]] std::string toml_value(const KeyInfo& info, const KeyValue& value);

/// "yaw_deg=30 pitch_deg=5 distance_mm=600 fov_deg=30 target_mm=0,0,0", as --camera takes it.
[[nodiscard]] std::string camera_text(const Camera& camera);
/// "yaw_deg=-60 pitch_deg=20 intensity=3 color=1,0.9,0.8", as --light takes it; point and spot lights have
/// distance_mm.
[[nodiscard]] std::string light_text(const Light& light, Vec3 target_mm = {});

}  // namespace dermis::inline scene
