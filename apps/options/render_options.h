#pragma once
// What render shares with every command that draws: scene, technique, settings, size, view.

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "dermis/render/renderer.h"
#include "dermis/technique/technique_list.h"
#include "scene_choice.h"

namespace dermis::cli {

inline constexpr NumberRange kRenderFramesRange = {1, 100000};

struct RenderOptions {
    SceneChoice scene = {.name = "bust"};
    std::string technique, size = "1024x1024", view = "final", device;
    std::vector<std::string> settings;  ///< name=value
    int samples = 1;
    bool validation = false;

    void add_to(Command& command);
};

/// A scene, ready to draw with a technique and its settings.
struct Prepared {
    Scene scene;
    Scene as_filed;  ///< what the scene's files say, before --scene, --camera and --light; without objects
    const Technique* technique = nullptr;
    std::optional<ParameterValues> values;
    DrawSettings draw;
};

/// Everything that can be wrong with the options is found here, before a device is opened.
[[nodiscard]] Result<Prepared> prepare(const RenderOptions& options);
/// The same, but complete_scene() is still to come.
[[nodiscard]] Result<Prepared> prepare_unbaked(const RenderOptions& options);

/// 1 or 4 a pixel.
[[nodiscard]] Result<void> check_samples(int samples);
/// A debug view that the technique has.
[[nodiscard]] Result<void> check_view(const Technique& technique, const std::string& view);

/// `technique` as parse_technique() takes it, else the scene's, else the default
/// that suits it; then `settings`,
/// "name=value". The scene's own settings apply to its technique, unless brackets say what to set.
[[nodiscard]] Result<Contestant> chosen_technique(const std::string& technique,
                                                  const std::vector<std::string>& settings,
                                                  const Scene* scene);

}  // namespace dermis::cli
