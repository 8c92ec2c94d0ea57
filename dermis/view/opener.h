#pragma once
// Opens scenes, panoramas and pictures, and reads them again when their files change.

#include <future>
#include <string>

#include "dermis/view/clock.h"
#include "dermis/view/loader.h"
#include "dermis/view/pictures.h"
#include "dermis/view/reference.h"
#include "dermis/view/viewer.h"

namespace dermis::view {

/// The changes by an opened file.
struct OpenTargets {
    gpu::Device& device;
    const Clock& clock;
    Model& model;
    Pictures& pictures;
    Reference& reference;
};

class Opener {
  public:
    /// `first`: the scene that is being loaded already. Options and targets must outlive it.
    Opener(const ViewerOptions& options, std::future<Result<Start>> first, const OpenTargets& targets);

    /// A scene, mesh, panorama or picture, by its extension; errors are notices.
    void open(const std::string& path);
    /// A scene: a file, a name, builtin:NAME.
    void load(const std::string& path, Load what = Load::scene);
    /// The shown scene again, in the pose that its motion has now; only its objects change. Not while another
    /// one is loading.
    void load_pose();
    /// Model::loading_words have changed since the scene was loaded with them.
    [[nodiscard]] bool has_new_words() const;
    /// Then the scene is read again. If it cannot be, the words become again those that it was loaded with.
    void follow_words();
    [[nodiscard]] bool is_loading() const { return loader_.is_loading(); }
    /// The path of the scene that is being read; if none is, of the last one.
    [[nodiscard]] const std::string& loaded_path() const { return loader_.path(); }
    void wait() const { loader_.wait(); }

    /// Shows what has come: true. A new scene comes without its bakes, which follow. The first one's error
    /// ends the program, a later one's is a notice.
    [[nodiscard]] Result<bool> take();
    /// Looks at the files of scene and shaders, a few times a second. True when something changed.
    [[nodiscard]] bool follow_files();

  private:
    [[nodiscard]] Result<void> take(Start start);
    [[nodiscard]] Result<void> show(Start start);
    void take_start(const Start& start);
    void take_words(std::vector<SceneWord> loaded);
    void take_technique(const Scene& file);
    void open_panorama(const std::string& path);
    [[nodiscard]] bool follow_scene_files();

    const ViewerOptions& options_;
    OpenTargets to_;
    Loader loader_;
    std::vector<SceneWord> shown_words_;  ///< with which the shown scene was loaded
    bool first_ = true;                   ///< no scene was shown whole yet
    double last_look_s_ = 0;
};

}  // namespace dermis::view
