#include "render_options.h"
#include "catalog/catalog.h"

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/render/complete_scene.h"

namespace dermis::cli {

void RenderOptions::add_to(Command& command) {
    scene.add_to(command)->capture_default_str();
    command.add_option(
        "-t,--technique", technique,
        "ID or ID[NAME=VALUE,preset=NAME], listed by dermis techniques (default: the scene's, or "
        "the one with the highest share on heads)");
    command.add_option("--set", settings, "a parameter of the technique, NAME=VALUE; may be repeated")
        ->allow_extra_args(false);
    command.add_option("--size", size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    command
        .add_option("--view", view,
                    "what is shown: final, diffuse, specular, normal, albedo, curvature, tension, ...")
        ->capture_default_str();
    command.add_option("--samples", samples, {1, 4}, "samples per pixel: 1 or 4")->capture_default_str();
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

Result<Contestant> chosen_technique(const std::string& technique, const std::vector<std::string>& settings,
                                    const Scene* scene) {
    const std::span<const Technique> techniques = built_in_catalog().techniques;
    std::string text = technique;
    if (text.empty() && scene) text = scene->technique;
    if (text.empty()) {
        DERMIS_TRY_ASSIGN(const Technique* usual, find_default(techniques));
        text = usual->id;
    }
    DERMIS_TRY_ASSIGN(Contestant chosen, parse_technique(techniques, text));
    if (scene && text == scene->technique)
        if (Result<void> set = chosen.values.set_all(scene->settings); !set)
            return set.error().within(scene->name + ": [settings]");
    if (Result<void> set = chosen.values.set_all(settings); !set) return set.error().within("--set");
    DERMIS_TRY(check_settings(*chosen.technique, chosen.values));
    return chosen;
}

Result<Prepared> prepare(const RenderOptions& options) {
    DERMIS_TRY_ASSIGN(Prepared prepared, prepare_unbaked(options));
    DERMIS_TRY(complete_scene(prepared.scene));
    return prepared;
}

Result<Prepared> prepare_unbaked(const RenderOptions& options) {
    DERMIS_TRY_ASSIGN(const Size size, parse_size(options.size));
    DERMIS_TRY(check_samples(options.samples));
    if (!options.technique.empty()) DERMIS_TRY(chosen_technique(options.technique, {}, nullptr));

    Scene as_filed;
    Result<Scene> scene = options.scene.load(&as_filed);
    if (!scene) return scene.error();
    DERMIS_TRY_ASSIGN(const Contestant chosen,
                      chosen_technique(options.technique, options.settings, &*scene));
    DERMIS_TRY(check_view(*chosen.technique, options.view));
    return Prepared{
        .scene = std::move(*scene),
        .as_filed = std::move(as_filed),
        .technique = chosen.technique,
        .values = chosen.values,
        .draw = {
            .width = size.width, .height = size.height, .samples = options.samples, .view = options.view}};
}

}  // namespace dermis::cli
