#include <memory>

#include "bake_options.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/optics/presets.h"

namespace dermis::cli {
namespace {

struct BakeShadowOptions {
    std::string profile = "gpu_gems_3", size = "256x64", range = "1,40", warp = "linear";
    double sharpening = 3;
    TableOutput output;
};

Result<int> run(const BakeShadowOptions& options) {
    Result<Profile> profile = find_profile(options.profile);
    if (!profile) return profile.error();
    const Result<Size> size = parse_size(options.size);
    if (!size) return size.error();
    const Result<Range> range = parse_range("--range", options.range);
    if (!range) return range.error();
    const Result<AxisWarp> warp = find_warp(options.warp);
    if (!warp) return warp.error();
    const Result<TableStorage> storage = options.output.chosen_storage();
    if (!storage) return storage.error();
    const ShadowOptions shadow{.profile = std::move(*profile),
                               .width = size->width,
                               .height = size->height,
                               .min_width_mm = range->min,
                               .max_width_mm = range->max,
                               .width_warp = *warp,
                               .sharpening = options.sharpening};
    Result<Table> table = bake_shadow(shadow);
    if (!table) return table.error();
    table->convention.encoding = encoding_for(TableKind::shadow, *storage);
    return deliver(*table, shadow.profile, options.output, *storage);
}

}  // namespace

void add_bake_shadow_command(CommandLine& line) {
    auto options = std::make_shared<BakeShadowOptions>();
    Command* command = line.add(
        "shadow", "Light that scatters into a penumbra, over its position and width",
        "dermis bake shadow --range 1,40 --sharpening 3 -o shadow.exr --plot shadow.svg", bake_group(line));
    command->add_option("--profile", options->profile, "preset, CSV file or burley:R,G,B");
    command->add_option("--size", options->size, "WIDTHxHEIGHT");
    command->add_option("--range", options->range, "MIN,MAX of the penumbra's width in mm");
    command->add_option("--warp", options->warp, "spacing of the rows: linear, or squared (finer near MIN)");
    command->add_option("--sharpening", options->sharpening,
                        "width of the filter divided by the width of the light's edge");
    options->output.add_to(command);
    line.when_chosen(command, [options] { return run(*options); });
}

}  // namespace dermis::cli
