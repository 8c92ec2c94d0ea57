// dermis figures: reproduces the figures of a technique's source and compares them.

#include <cstdio>
#include <memory>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/base/progress.h"
#include "dermis/figures/figures.h"
#include "dermis/image/io.h"
#include "scene_choice.h"

namespace dermis::cli {
namespace {

struct FiguresOptions {
    SceneChoice scene;
    std::string technique, output = "out/figures", only, device;
    int size = 320, samples = 4;
};

Result<void> check(const FiguresOptions& options) {
    if (options.size < 16 || options.size > 2048)
        return Error{"--size " + std::to_string(options.size) +
                     ": the height of a cell in pixels, 16 to 2048"};
    if (options.samples != 1 && options.samples != 4)
        return Error{"--samples " + std::to_string(options.samples) + ": 1 or 4"};
    return {};
}

void print(const std::string& path, const FigureResult& result) {
    std::printf("%s\n", path.c_str());
    for (const CellReport& cell : result.cells)
        if (!cell.compared_to.empty())
            std::printf("  %-44s mean %.5f  max %.4f  FLIP %.4f  against %s\n", cell.label.c_str(),
                        cell.difference.mean_abs, cell.difference.max_abs, cell.difference.flip,
                        cell.compared_to.c_str());
}

Result<int> make_figures(const FiguresOptions& options) {
    if (Result<void> good = check(options); !good) return good.error();
    const Result<const Technique*> technique =
        find_technique(built_in_catalog().techniques, options.technique);
    if (!technique) return technique.error();
    const Result<std::vector<Figure>> figures = figures_of(**technique, options.only);
    if (!figures) return figures.error();
    const Result<std::vector<SceneWord>> words = options.scene.all_words();
    if (!words) return words.error();
    const Result<Font> font = Font::load();
    if (!font) return font.error();
    Result<gpu::Device> device = gpu::Device::create({.name_contains = options.device});
    if (!device) return device.error();

    size_t cells = 0;
    for (const Figure& figure : *figures)
        for (const FigureRow& row : figure.rows) cells += row.cells.size();
    Progress progress("figures", cells);
    CellRenderer renderer(*device, built_in_catalog(),
                          {.scene = options.scene.name,
                           .samples = options.samples,
                           .loading_words = words_for(*words, true),
                           .words = words_for(*words, false)});
    for (const Figure& figure : *figures) {
        const Result<FigureResult> result =
            draw_figure(renderer, *font, figure, options.size, [&] { progress.advance(); });
        if (!result) return result.error();
        ImageText text = {{"Software", "dermis"}, {"Description", figure.title + " (" + figure.source + ")"}};
        for (const std::string& credit : result->credits) text["Copyright"] = credit;
        const std::string path = options.output + "/" + figure.id + ".png";
        if (Result<void> written = write_image(path, result->sheet, text); !written) return written.error();
        print(path, *result);
    }
    return 0;
}

}  // namespace

void add_figures_command(CommandLine& line) {
    const auto options = std::make_shared<FiguresOptions>();
    Command* command =
        line.add("figures", "Reproduces the figures of a technique's source, with differences in numbers",
                 "dermis figures preintegrated -o out/figures --size 400");
    command->add_option("TECHNIQUE", options->technique, "id of the technique (dermis techniques lists them)")
        ->required();
    command->add_option("SCENE", options->scene.name, "draw this scene instead of each figure's own");
    options->scene.add_options_to(*command);
    command->add_option("-o,--output", options->output, "directory; each figure is one PNG")
        ->capture_default_str();
    command->add_option("--size", options->size, "height of a cell in pixels")->capture_default_str();
    command->add_option("--only", options->only, "draw only the figure with this id");
    command->add_option("--samples", options->samples, "samples a pixel: 1 or 4")->capture_default_str();
    command->add_option("--device", options->device, "use the Vulkan device with this text in its name");
    line.when_chosen(command, [options] { return make_figures(*options); });
}

}  // namespace dermis::cli
