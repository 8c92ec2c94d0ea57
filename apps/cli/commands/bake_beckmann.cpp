#include <memory>

#include "bake_options.h"
#include "dermis/bake/beckmann_table.h"
#include "dermis/base/text.h"

namespace dermis::cli {
namespace {

struct BakeBeckmannOptions {
    std::string size = "256", layout = "linear";
    TableOutput output;
};

Result<int> run(const BakeBeckmannOptions& options) {
    DERMIS_TRY_ASSIGN(const Size size, parse_size(options.size));
    BeckmannOptions beckmann{.width = size.width, .height = size.height};
    if (options.layout == "gems")
        beckmann.layout = BeckmannLayout::gems_8_bit;
    else if (options.layout != "linear")
        return Error{unknown_name("layout", options.layout, std::vector<std::string>{"linear", "gems"})};
    const bool linear = beckmann.layout == BeckmannLayout::linear;
    DERMIS_TRY_ASSIGN(const TableStorage storage,
                      options.output.chosen_storage(linear ? TableStorage::automatic : TableStorage::u8));
    if (linear && (storage == TableStorage::u8 || storage == TableStorage::u16))
        return Error{options.output.path + ": Beckmann's values exceed 1; write .exr, or --layout gems"};
    Result<Table> table = bake_beckmann(beckmann);
    if (!table) return table.error();
    return deliver({.table = std::move(*table), .profile = {}}, options.output, storage);
}

}  // namespace

void add_bake_beckmann_command(CommandLine& line) {
    auto options = std::make_shared<BakeBeckmannOptions>();
    Command* command =
        line.add("beckmann", "Beckmann's distribution for Kelemen/Szirmay-Kalos specular light",
                 "dermis bake beckmann --storage float -o beckmann.exr\n"
                 "  dermis bake beckmann --layout gems --size 512 -o beckmann.png",
                 bake_group(line));
    command->add_option("--size", options->size, "WIDTHxHEIGHT or one side");
    command->add_option("--layout", options->layout, "encoding: linear, or gems (value^0.1 / 2, 8 bit)");
    options->output.add_to(command);
    line.when_chosen(
        command, [options] { return Result<FileUse>(options->output.files()); },
        [options] { return run(*options); });
}

}  // namespace dermis::cli
