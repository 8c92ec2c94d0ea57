#include <memory>

#include "bake_options.h"
#include "profile_options.h"

namespace dermis::cli {
namespace {

struct BakeLutOptions {
    LutChoice lut;
    TableOutput output;
};

Result<int> run(const BakeLutOptions& options) {
    DERMIS_TRY_ASSIGN(LutOptions lut, options.lut.options());
    DERMIS_TRY_ASSIGN(const TableStorage storage, options.output.chosen_storage(lut.storage));
    DERMIS_TRY_ASSIGN(MadeTable made, make_table(std::move(lut)));
    return deliver(std::move(made), options.output, storage);
}

}  // namespace

void add_bake_lut_command(CommandLine& line) {
    auto options = std::make_shared<BakeLutOptions>();
    Command* command =
        line.add("lut", "Pre-integrated diffuse light over N.L and curvature",
                 "dermis bake lut --profile jensen_skin1 --size 256 -o skin.exr --plot skin.svg\n"
                 "  dermis bake lut --convention unity_2011 --profile openpbr_skin_5 -o unity.png",
                 bake_group(line));
    command->add_option("--convention", options->lut.convention,
                        "dermis (exact, sphere), or a published table: penner, unity_2011, faceworks");
    command->add_option("--construction", options->lut.construction,
                        "sphere, full_ring or half_ring (-90 to 90 degrees)");
    command->add_option("--ring-weights", options->lut.ring_weights,
                        "normalisation of the ring's Gaussians: line (as in published code) or area");
    command->add_option("--variance-scale", options->lut.variance_scale, kVarianceScaleRange,
                        "factor on every variance");
    command->add_option("--profile", options->lut.profile, kProfileNames);
    command->add_option("--size", options->lut.size, "WIDTHxHEIGHT or one side");
    command->add_option("--axis", options->lut.axis, "meaning of the rows: curvature (1/mm) or radius (mm)");
    command->add_option("--range", options->lut.range, "MIN,MAX of the rows' axis");
    command->add_option("--warp", options->lut.warp,
                        "spacing of the rows: linear, or squared (finer near MIN)");
    options->output.add_to(command);
    line.when_chosen(
        command, [options] { return Result<FileUse>(options->output.files(options->lut.profile)); },
        [options] { return run(*options); });
}

}  // namespace dermis::cli
