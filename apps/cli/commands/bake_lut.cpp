#include <cstdio>
#include <memory>

#include "bake_options.h"
#include "dermis/bake/lut.h"
#include "dermis/base/text.h"
#include "dermis/optics/presets.h"

namespace dermis::cli {
namespace {

struct BakeLutOptions {
    std::string convention = "dermis", construction, ring_weights, profile, size, axis, range, warp;
    double variance_scale = 0;
    TableOutput output;
};

Result<void> choose_axis(const BakeLutOptions& options, TableAxis& axis) {
    if (!options.axis.empty()) {
        if (options.axis == "radius")
            axis = radius_axis(1, 32);
        else if (options.axis == "curvature")
            axis = curvature_axis(0, 0.5);
        else
            return Error{unknown_name("axis", options.axis, std::vector<std::string>{"curvature", "radius"})};
    }
    if (!options.range.empty()) {
        const Result<Range> range = parse_range("--range", options.range);
        if (!range) return range.error();
        axis.min = range->min;
        axis.max = range->max;
    }
    if (!options.warp.empty()) {
        const Result<AxisWarp> warp = find_warp(options.warp);
        if (!warp) return warp.error();
        axis.warp = *warp;
    }
    return {};
}

Result<void> choose_construction(const BakeLutOptions& options, Convention& convention) {
    if (!options.construction.empty()) {
        const Result<Construction> construction = find_construction(options.construction);
        if (!construction) return construction.error();
        convention.how.construction = *construction;
    }
    if (options.ring_weights == "area")
        convention.how.ring_weights = RingWeights::area;
    else if (!options.ring_weights.empty() && options.ring_weights != "line")
        return Error{
            unknown_name("ring weights", options.ring_weights, std::vector<std::string>{"line", "area"})};
    if (options.variance_scale != 0) convention.how.variance_scale = options.variance_scale;
    return {};
}

Result<int> run(const BakeLutOptions& options) {
    Result<LutOptions> lut = lut_options(options.convention);
    if (!lut) return lut.error();
    if (!options.profile.empty()) {
        Result<Profile> profile = find_profile(options.profile);
        if (!profile) return profile.error();
        lut->profile = std::move(*profile);
    }
    if (!options.size.empty()) {
        const Result<Size> size = parse_size(options.size);
        if (!size) return size.error();
        lut->width = size->width;
        lut->height = size->height;
    }
    if (Result<void> axis = choose_axis(options, lut->convention.axes[1]); !axis) return axis.error();
    if (Result<void> how = choose_construction(options, lut->convention); !how) return how.error();
    const Result<TableStorage> storage = options.output.chosen_storage(lut->storage);
    if (!storage) return storage.error();
    if (options.convention == "dermis" || options.convention == "penner")
        lut->convention.encoding = encoding_for(TableKind::diffuse, *storage);
    const std::string note = fit_where_needed(lut->profile, lut->convention.how, lut->convention.integration);
    const Result<Table> table = bake_lut(*lut);
    if (!table) return table.error();
    const Result<int> delivered = deliver(*table, lut->profile, options.output, *storage);
    if (delivered) std::printf("%s", note.c_str());
    return delivered;
}

}  // namespace

void add_bake_lut_command(CommandLine& line) {
    auto options = std::make_shared<BakeLutOptions>();
    Command* command =
        line.add("lut", "Pre-integrated diffuse light over N.L and curvature",
                 "dermis bake lut --profile jensen_skin1 --size 256 -o skin.exr --plot skin.svg\n"
                 "  dermis bake lut --convention unity_2011 --profile openpbr_skin_5 -o unity.png",
                 bake_group(line));
    command->add_option("--convention", options->convention,
                        "dermis (exact, sphere), or a published table: penner, unity_2011, faceworks");
    command->add_option("--construction", options->construction,
                        "sphere, ring or half_ring (-90 to 90 degrees)");
    command->add_option("--ring-weights", options->ring_weights,
                        "normalisation of the ring's Gaussians: line (as in published code) or area");
    command->add_option("--variance-scale", options->variance_scale, "factor on every variance");
    command->add_option("--profile", options->profile,
                        "preset, CSV file or burley:R,G,B (see dermis profile list)");
    command->add_option("--size", options->size, "WIDTHxHEIGHT or one side");
    command->add_option("--axis", options->axis, "meaning of the rows: curvature (1/mm) or radius (mm)");
    command->add_option("--range", options->range, "MIN,MAX of the rows' axis");
    command->add_option("--warp", options->warp, "spacing of the rows: linear, or squared (finer near MIN)");
    options->output.add_to(command);
    line.when_chosen(command, [options] { return run(*options); });
}

}  // namespace dermis::cli
