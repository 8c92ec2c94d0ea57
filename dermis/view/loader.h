#pragma once
// Reads scenes in the background, and finds out when their files have changed.

#include <future>
#include <optional>
#include <string>

#include "dermis/view/file_watch.h"
#include "dermis/view/viewer.h"

namespace dermis::view {

/// What is loaded.
enum class Load {
    scene,       ///< a new one: its bakes come later, by complete()
    same_scene,  ///< the one that is shown, again: what was changed stays
    pose,        ///< the one that is shown, in another pose
    bakes,       ///< what a new scene lacks
};

class Loader {
  public:
    /// The first scene, whose loading has begun already.
    Loader(std::future<Result<Start>> first, std::string path, std::span<const Subject> subjects)
        : loading_(std::move(first)), path_(std::move(path)), subjects_(subjects) {}

    /// Begins to load. False while another one is loading: path() names it.
    [[nodiscard]] bool load(const std::string& path, const std::vector<SceneWord>& words, Load what);
    /// Begins to bake what `scene`, the one that was loaded last, lacks.
    void complete(Scene scene);
    [[nodiscard]] bool is_loading() const { return loading_.valid(); }
    /// What is being loaded; if nothing is, what was loaded last.
    [[nodiscard]] Load what() const { return what_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Takes the result if there is one.
    [[nodiscard]] std::optional<Result<Start>> take();
    void wait() const {
        if (loading_.valid()) loading_.wait();
    }

    [[nodiscard]] bool is_reload() const { return what_ == Load::same_scene; }
    /// The scene file itself has changed since it was shown, not only its meshes and maps.
    void note_changed_file() { file_changed_ = true; }
    [[nodiscard]] bool file_changed() const { return file_changed_; }

    /// The scene is complete: its files are watched from here on.
    void follow(const Scene& scene);
    /// These too: of a scene that cannot be drawn yet, or a panorama that was dropped.
    void follow_too(const std::vector<std::filesystem::path>& files) { files_.add(files); }
    /// The files that the scene file names, existing or not; a scene that could not be read waits for them.
    void follow_stated_files() { files_.add(stated_files()); }
    [[nodiscard]] std::vector<std::filesystem::path> changed_files() { return files_.changed(); }

  private:
    [[nodiscard]] std::vector<std::filesystem::path> stated_files() const;

    std::future<Result<Start>> loading_;
    std::string path_;
    std::span<const Subject> subjects_;
    Load what_ = Load::scene;
    bool file_changed_ = false;
    FileWatch files_;
};

[[nodiscard]] bool is_scene_file(const std::filesystem::path& file);

}  // namespace dermis::view
