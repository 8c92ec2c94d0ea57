// dermis passes: the whole frame of a technique as text; touches no GPU.

#include <cstdio>
#include <memory>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/base/text.h"
#include "dermis/render/shared_passes.h"
#include "render_options.h"

namespace dermis::cli {
namespace {

struct PassesOptions {
    std::string technique, view = "final";
    std::vector<std::string> settings;
    int samples = 1;
};

Result<int> print_passes(const PassesOptions& options) {
    DERMIS_TRY_ASSIGN(const Contestant chosen,
                      chosen_technique(options.technique, options.settings, nullptr));
    DERMIS_TRY(check_view(*chosen.technique, options.view));
    DERMIS_TRY(check_samples(options.samples));
    const PassList own = chosen.technique->build(chosen.values, {.view = options.view});
    std::printf("%s",
                describe(frame_passes(own, {.samples = options.samples, .view = options.view})).c_str());
    return 0;
}

}  // namespace

void add_passes_command(CommandLine& line) {
    const auto options = std::make_shared<PassesOptions>();
    Command* command = line.add("passes", "Prints the passes of a technique's frame, without a GPU",
                                "dermis passes lambert --set specular=blinn_phong");
    command->add_option("ID", options->technique, "ID or ID[NAME=VALUE], listed by dermis techniques")
        ->required();
    command->add_option("--set", options->settings, "a parameter, name=value; may be repeated")
        ->allow_extra_args(false);
    command->add_option("--samples", options->samples, {1, 4}, "samples per pixel: 1 or 4")
        ->capture_default_str();
    command->add_option("--view", options->view, "debug view")->capture_default_str();
    line.when_chosen(command, writes_nothing, [options] { return print_passes(*options); });
}

}  // namespace dermis::cli
