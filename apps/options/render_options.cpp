#include "render_options.h"
#include "catalog/catalog.h"

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/render/complete_scene.h"

namespace dermis::cli {

void RenderOptions::add_to(Command& command) {
    scene.add_to(command)->capture_default_str();
    command.add_option("-t,--technique", technique,
                       "id of the technique, listed by dermis techniques (default: the scene's, or lambert)");
    command.add_option("--set", settings, "a parameter of the technique, NAME=VALUE; may be repeated")
        ->allow_extra_args(false);
    command.add_option("--size", size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    command
        .add_option("--view", view,
                    "what is shown: final, diffuse, specular, normal, albedo, curvature, shadow, ...")
        ->capture_default_str();
    command.add_option("--samples", samples, {1, 4}, "samples a pixel: 1 or 4")->capture_default_str();
    command.add_option("--device", device, "use the Vulkan device with this text in its name");
    command.add_flag("--validate", validation, "run under the Vulkan validation layers; fail on any message");
}

Result<void> check_samples(int samples) {
    if (samples == 1 || samples == 4) return {};
    return Error{"--samples " + std::to_string(samples) + ": 1 or 4"};
}

Result<void> check_view(const Technique& technique, const std::string& view) {
    const std::vector<std::string> views = view_names(technique);
    if (std::ranges::find(views, view) != views.end()) return {};
    return Error{unknown_name("view", view, views)};
}

Result<void> apply_setting(ParameterValues& values, const std::string& setting) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos) return Error{"--set '" + setting + "': write name=value"};
    return values.set(setting.substr(0, equals), setting.substr(equals + 1));
}

Result<Prepared> prepare(const RenderOptions& options) {
    DERMIS_TRY_ASSIGN(const Size size, parse_size(options.size));
    DERMIS_TRY(check_samples(options.samples));
    if (!options.technique.empty())
        DERMIS_TRY(find_technique(built_in_catalog().techniques, options.technique));

    Scene as_filed;
    Result<Scene> scene = options.scene.load(&as_filed);
    if (!scene) return scene.error();
    DERMIS_TRY(complete_scene(*scene));

    const bool scenes_own = options.technique.empty() || options.technique == scene->technique;
    const std::string& id = scenes_own ? scene->technique : options.technique;
    const std::span<const Technique> techniques = built_in_catalog().techniques;
    const Result<const Technique*> technique =
        id.empty() ? find_baseline(techniques) : find_technique(techniques, id);
    if (!technique) return technique.error();
    ParameterValues values((*technique)->parameters);
    if (scenes_own)
        for (const auto& [name, text] : scene->settings)
            if (Result<void> set = values.set(name, text); !set)
                return Error{options.scene.name + ": [settings] " + set.error().message};
    for (const std::string& setting : options.settings) DERMIS_TRY(apply_setting(values, setting));

    DERMIS_TRY(check_view(**technique, options.view));
    return Prepared{
        .scene = std::move(*scene),
        .as_filed = std::move(as_filed),
        .technique = *technique,
        .values = values,
        .draw = {
            .width = size.width, .height = size.height, .samples = options.samples, .view = options.view}};
}

}  // namespace dermis::cli
