#pragma once
// What render shares with every command that draws: scene, technique, settings, size, view.

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "dermis/render/renderer.h"
#include "dermis/scene/scene.h"
#include "dermis/technique/technique.h"

namespace dermis::cli {

struct RenderOptions {
    std::string scene = "bust", technique, size = "1024x1024", camera, light, look, environment,
                view = "final", device;
    std::vector<std::string> settings;  ///< name=value
    int samples = 1;
    bool validation = false;

    void add_to(Command& command);
};

/// A scene, ready to draw with a technique and its settings.
struct Prepared {
    Scene scene;
    const Technique* technique = nullptr;
    std::optional<ParameterValues> values;
    DrawSettings draw;
};

/// Everything that can be wrong with the options is found here, before a device is opened.
[[nodiscard]] Result<Prepared> prepare(const RenderOptions& options);

/// --camera and --light, as parse_camera and parse_light have them; empty ones change nothing. Call it before
/// anything is derived from the scene's views.
[[nodiscard]] Result<void> apply_views(Scene& scene, const std::string& camera, const std::string& light);

/// --look and --environment; empty ones change nothing.
[[nodiscard]] Result<void> apply_looks(Scene& scene, const std::string& look, const std::string& environment);

/// "1024x768", each side 1 to 8192.
[[nodiscard]] Result<std::pair<int, int>> parse_size(std::string_view text);

/// Splits name=value and sets it.
[[nodiscard]] Result<void> apply_setting(ParameterValues& values, const std::string& setting);

}  // namespace dermis::cli
