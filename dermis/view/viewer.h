#pragma once
// dermis view: a window that shows the techniques while camera, light and parameters change.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dermis/image/image.h"
#include "dermis/scene/scene.h"
#include "dermis/technique/technique.h"
#include "dermis/view/model.h"
#include "dermis/view/script.h"
#include "dermis/view/window.h"

namespace dermis::view {

/// State that a window with a lost device passes to the next one.
struct Handed {
    Model model;  ///< without its scene
    Image reference;
    std::string reference_view;
    Pose loaded_pose;  ///< in which the scene was loaded
};

/// Options of the window.
struct Start {
    Scene scene;
    bool lacks_bakes = false;              ///< complete_scene() is still to come
    std::vector<SceneWord> loading_words;  ///< see Model
    const Technique* technique = nullptr;
    std::optional<ParameterValues> values;
    std::string view = "final";
    std::optional<Scene> file_look;  ///< what the files say, without objects, when `scene` has something else
    std::optional<Handed> handed;
};

struct ViewerOptions {
    Catalog catalog;
    std::string scene_path;
    /// Loads the first scene; runs beside the opening of window and device.
    std::function<Result<Start>()> load;
    WindowSize size = {1280, 800};
    std::string device;       ///< part of a Vulkan device's name
    bool validation = false;  ///< any message of the layers is an error at the end
    std::function<void(const std::string& message)> on_message;  ///< of the layers, as it comes
    int samples = 4;                                             ///< a pixel of the finished picture: 1 or 4
    float interface_scale = 0;  ///< 0: from the display and the window's height
    int frames = 0;             ///< end after this number of frames; 0: when the user closes the window
    std::vector<ScriptCommand> script;
    std::string
        shader_root;  ///< with shaders/ and techniques/, to follow their changes; empty: the source tree
    std::string reference;                               ///< a picture to compare with
    bool keeps_state = true;                             ///< window size and recent scenes
    std::string script_name;                             ///< for messages
    std::function<void(const std::string& line)> print;  ///< what the script's print says
};

/// Summary of a run, printed as one line.
struct ViewerReport {
    int frames = 0;
    std::optional<double> first_picture_s;  ///< from the call to the first presented picture
    std::string device;
};

/// Returns when the window was closed. Errors: no display, no device, a first scene that does not load, a
/// script's command that fails. A scene dropped later that does not load is a notice in the window.
[[nodiscard]] Result<ViewerReport> run_viewer(const ViewerOptions& options);

}  // namespace dermis::view
