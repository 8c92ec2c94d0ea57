#pragma once
// Which scene a command draws and what of it is changed: SCENE --scene KEY=VALUE ... --camera "..." --light
// "...".

#include <string>
#include <vector>

#include "command.h"
#include "dermis/scene/scene_words.h"
#include "pose_choice.h"

namespace dermis::cli {

struct SceneChoice {
    std::string name, camera, light;
    std::vector<std::string> words;
    PoseChoice pose;
    double unit_mm = 0;  ///< of the mesh file; 0: as the file or the scene has it

    /// The scene as the first argument, and the options.
    Option* add_to(Command& command);
    /// The options alone.
    void add_options_to(Command& command);

    /// Loads and changes it. `as_filed` gets what the scene's files say, without objects: which --scene keys
    /// are read while loading counts as theirs. Errors as load_scene() and set_words().
    [[nodiscard]] Result<Scene> load(Scene* as_filed = nullptr) const;

    /// All words; those that are read while loading, or the others.
    [[nodiscard]] Result<std::vector<SceneWord>> all_words() const;
};

/// Whether the outputs of a command replace none of the files that the loaded scene is made of.
[[nodiscard]] Result<void> keep_scene_files(const Scene& scene, const Result<FileUse>& files);

/// set_words(), and an error for a camera that looks nowhere.
[[nodiscard]] Result<void> change_scene(Scene& scene, const std::vector<SceneWord>& words);

/// Those of `words` that is_loading_key() says are, or are not, read while a scene is loaded.
[[nodiscard]] std::vector<SceneWord> words_for(const std::vector<SceneWord>& words, bool loading);

}  // namespace dermis::cli
