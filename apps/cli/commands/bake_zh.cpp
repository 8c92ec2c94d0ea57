#include <memory>

#include "bake_options.h"
#include "profile_options.h"

namespace dermis::cli {
namespace {

struct BakeZhOptions {
    ZhChoice zh;
    TableOutput output;
};

Result<int> run(const BakeZhOptions& options) {
    DERMIS_TRY_ASSIGN(ZonalOptions zonal, options.zh.options());
    DERMIS_TRY_ASSIGN(const TableStorage storage,
                      options.output.chosen_storage(preferred_storage(zonal.layout)));
    DERMIS_TRY(check_zonal_storage(options.output.path, zonal.layout, storage));
    DERMIS_TRY_ASSIGN(MadeTable made, make_table(std::move(zonal)));
    return deliver(std::move(made), options.output, storage);
}

}  // namespace

void add_bake_zh_command(CommandLine& line) {
    auto options = std::make_shared<BakeZhOptions>();
    Command* command = line.add("zh", "Zonal harmonics 0 to 2 of pre-integrated skin over curvature",
                                "dermis bake zh --profile gpu_gems_3 -o skin_zh.exr\n"
                                "  dermis bake zh --layout remapped --construction half_ring -o skin_zh.png",
                                bake_group(line));
    command->add_option("--profile", options->zh.profile, kProfileNames);
    command->add_option("--construction", options->zh.construction,
                        "sphere, full_ring or half_ring (-90 to 90 degrees)");
    command->add_option("--variance-scale", options->zh.variance_scale, kVarianceScaleRange,
                        "factor on every variance (1.414 in widely copied code)");
    command->add_option("--axis", options->zh.axis,
                        "meaning of the columns: curvature (1/mm) or radius (mm)");
    command->add_option("--range", options->zh.range, "MIN,MAX of the axis");
    command->add_option("--size", options->zh.width, {2, 8192}, "columns");
    command->add_option("--layout", options->zh.layout,
                        "encoding: float (3 rows) or remapped (2 rows, 0.75..1.05, 8 bit)");
    options->output.add_to(command);
    line.when_chosen(
        command, [options] { return Result<FileUse>(options->output.files(options->zh.profile)); },
        [options] { return run(*options); });
}

}  // namespace dermis::cli
