// dermis export: the shading functions with a skin's coefficients, in the language of an engine, or as a
// folder that the engine or a browser opens.

#include <memory>

#include "command.h"
#include "dermis/base/text.h"
#include "dermis/engines/native.h"
#include "dermis/shading/skin_text.h"
#include "export_options.h"
#include "profile_options.h"

namespace dermis::cli {
namespace {

Result<int> run(const ExportOptions& options) {
    DERMIS_TRY_ASSIGN(const Exported made, make_export(options));
    print_warnings(made.warnings);
    DERMIS_TRY(write_export(made));
    for (const PackageFile& file : made.files) print_path(file.path);
    return 0;
}

}  // namespace

void add_export_command(CommandLine& line) {
    auto options = std::make_shared<ExportOptions>();
    Command* command = line.add(
        "export", "A skin for other programs: shading functions as text, a package for an engine, a web page",
        "dermis export --engine three bust -o package/\n"
        "  dermis export --engine godot --profile openpbr_skin_5 -o package/\n"
        "  dermis export --web head_scan --scene light.key.intensity=2 -o page/\n"
        "  dermis export --language hlsl --profile openpbr_skin_5 -o skin.hlsl");
    command->add_option("--language", options->language,
                        join(shading::language_names(), ", ") + ", or all: a file of each in a folder");
    command->add_option("--functions", options->functions,
                        "with --language: these functions and what they need, separated by commas, such as "
                        "skin_diffuse,skin_gain (default: all)");
    command->add_option(
        "--engine", options->engine,
        "a folder with shader, table, import settings and an example, with a SCENE its head too: " +
            join(engine_names(), ", "));
    command->add_flag(
        "--native", options->native,
        "with --engine: the profile of the engine's own skin instead, as an asset or script and "
        "numbers to type in: " +
            join(native_engine_names(), ", "));
    command->add_flag("--web", options->web,
                      "a folder for any web server: a page that shows a scene's skin (default: bust)");
    command->add_option(
        "--profile", options->profile,
        kProfileNames + ("; default: " + std::string(kExportProfile)) + ", with a scene the scene's");
    options->scene.add_to(*command);
    command
        ->add_output("-o,--output", options->output,
                     "file to write; with --engine, --web or --language all a folder")
        ->required();
    line.when_chosen(
        command, [options] { return options->files(); }, [options] { return run(*options); });
}

}  // namespace dermis::cli
