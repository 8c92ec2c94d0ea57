#include <memory>

#include "bake_options.h"
#include "profile_options.h"

namespace dermis::cli {
namespace {

struct BakeShadowOptions {
    ShadowChoice shadow;
    TableOutput output;
};

Result<int> run(const BakeShadowOptions& options) {
    DERMIS_TRY_ASSIGN(const ShadowOptions shadow, options.shadow.options());
    DERMIS_TRY_ASSIGN(const TableStorage storage, options.output.chosen_storage());
    DERMIS_TRY_ASSIGN(MadeTable made, make_table(shadow));
    return deliver(std::move(made), options.output, storage);
}

}  // namespace

void add_bake_shadow_command(CommandLine& line) {
    auto options = std::make_shared<BakeShadowOptions>();
    Command* command = line.add(
        "shadow", "Light that scatters into a penumbra, over its position and width",
        "dermis bake shadow --range 1,40 --sharpening 3 -o shadow.exr --plot shadow.svg", bake_group(line));
    command->add_option("--profile", options->shadow.profile, kProfileNames);
    command->add_option("--size", options->shadow.size, "WIDTHxHEIGHT");
    command->add_option("--range", options->shadow.range, "MIN,MAX of the penumbra's width in mm");
    command->add_option("--warp", options->shadow.warp,
                        "spacing of the rows: linear, or squared (finer near MIN)");
    command->add_option("--sharpening", options->shadow.sharpening, {1, 1000},
                        "width of the filter divided by the width of the light's edge");
    options->output.add_to(command);
    line.when_chosen(
        command, [options] { return Result<FileUse>(options->output.files(options->shadow.profile)); },
        [options] { return run(*options); });
}

}  // namespace dermis::cli
