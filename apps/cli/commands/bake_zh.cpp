#include <cstdio>
#include <memory>

#include "bake_options.h"
#include "dermis/bake/lut.h"
#include "dermis/bake/zonal_table.h"
#include "dermis/base/text.h"
#include "dermis/optics/presets.h"

namespace dermis::cli {
namespace {

struct BakeZhOptions {
    std::string profile = "gpu_gems_3", construction = "sphere", axis = "curvature", range, layout = "float";
    int width = 256;
    TableOutput output;
};

Result<ZonalOptions> zonal_options(const BakeZhOptions& options) {
    Result<Profile> profile = find_profile(options.profile);
    if (!profile) return profile.error();
    const Result<Construction> construction = find_construction(options.construction);
    if (!construction) return construction.error();
    ZonalOptions zonal{
        .profile = std::move(*profile), .width = options.width, .how = {.construction = *construction}};
    if (options.axis == "radius")
        zonal.curvature = radius_axis(1, 32);
    else if (options.axis != "curvature")
        return Error{unknown_name("axis", options.axis, std::vector<std::string>{"curvature", "radius"})};
    if (!options.range.empty()) {
        const Result<Range> range = parse_range("--range", options.range);
        if (!range) return range.error();
        zonal.curvature.min = range->min;
        zonal.curvature.max = range->max;
    }
    if (options.layout == "remapped")
        zonal.layout = ZonalLayout::two_rows_remapped_8;
    else if (options.layout != "float")
        return Error{unknown_name("layout", options.layout, std::vector<std::string>{"float", "remapped"})};
    return zonal;
}

Result<int> run(const BakeZhOptions& options) {
    Result<ZonalOptions> zonal = zonal_options(options);
    if (!zonal) return zonal.error();
    const bool remapped = zonal->layout == ZonalLayout::two_rows_remapped_8;
    const Result<TableStorage> storage =
        options.output.chosen_storage(remapped ? TableStorage::u8 : TableStorage::automatic);
    if (!storage) return storage.error();
    if (!remapped && (*storage == TableStorage::u8 || *storage == TableStorage::u16))
        return Error{
            options.output.path +
            ": zonal harmonics reach 1.03, which a PNG cannot hold; write .exr, or --layout remapped"};
    const std::string note = fit_where_needed(zonal->profile, zonal->how, Integration::exact);
    const Result<Table> table = bake_zonal_harmonics(*zonal);
    if (!table) return table.error();
    const Result<int> delivered = deliver(*table, zonal->profile, options.output, *storage);
    if (delivered) std::printf("%s", note.c_str());
    return delivered;
}

}  // namespace

void add_bake_zh_command(CommandLine& line) {
    auto options = std::make_shared<BakeZhOptions>();
    Command* command = line.add("zh", "Zonal harmonics 0 to 2 of pre-integrated skin over curvature",
                                "dermis bake zh --profile gpu_gems_3 -o skin_zh.exr\n"
                                "  dermis bake zh --layout remapped --construction ring -o skin_zh.png",
                                bake_group(line));
    command->add_option("--profile", options->profile, "preset, CSV file or burley:R,G,B");
    command->add_option("--construction", options->construction, "sphere, ring or half_ring");
    command->add_option("--axis", options->axis, "meaning of the columns: curvature (1/mm) or radius (mm)");
    command->add_option("--range", options->range, "MIN,MAX of the axis");
    command->add_option("--size", options->width, "columns");
    command->add_option("--layout", options->layout,
                        "encoding: float (3 rows) or remapped (2 rows, 0.75..1.05, 8 bit)");
    options->output.add_to(command);
    line.when_chosen(command, [options] { return run(*options); });
}

}  // namespace dermis::cli
