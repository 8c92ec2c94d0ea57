#pragma once
// Reads scenes in the background, and finds out when their files have changed.

#include <future>
#include <optional>
#include <string>

#include "dermis/view/file_watch.h"
#include "dermis/view/viewer.h"

namespace dermis::view {

class Loader {
  public:
    /// The first scene, whose loading has begun already.
    Loader(std::future<Result<Start>> first, std::string path, std::span<const Subject> subjects)
        : loading_(std::move(first)), path_(std::move(path)), subjects_(subjects) {}

    /// Begins to load. False while another one is loading: path() names it.
    [[nodiscard]] bool load(const std::string& path, const std::vector<SceneWord>& words);
    [[nodiscard]] bool is_loading() const { return loading_.valid(); }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Takes the result if there is one.
    [[nodiscard]] std::optional<Result<Start>> take();
    void wait() const {
        if (loading_.valid()) loading_.wait();
    }

    /// The scene that is read is the one that is shown, again: what was changed stays. `file_changed`: the
    /// scene file itself has, not only its meshes and maps.
    void expect_same_scene(bool file_changed);
    [[nodiscard]] bool is_reload() const { return reload_; }
    /// The scene that is read is the one that is shown, in another pose.
    void expect_pose() { pose_ = true; }
    [[nodiscard]] bool is_pose() const { return pose_; }
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
    bool reload_ = false, file_changed_ = false, pose_ = false;
    FileWatch files_;
};

[[nodiscard]] bool is_scene_file(const std::filesystem::path& file);

}  // namespace dermis::view
