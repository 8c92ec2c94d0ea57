// dermis figures: reproduces the figures of a technique's source and compares them.

#include <cstdio>
#include <memory>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/base/progress.h"
#include "dermis/image/io.h"
#include "dermis/report/figures.h"
#include "render_options.h"

namespace dermis::cli {
namespace {

struct FiguresOptions {
    SceneChoice scene;
    std::string technique, output = "out/figures", only, device;
    int size = 320, samples = 4;
};

void print(const std::string& path, const FigureResult& result) {
    print_path(path);
    for (const CellReport& cell : result.cells)
        if (!cell.compared_to.empty())
            std::printf("  %-44s mean %.5f  max %.4f  FLIP %.4f  against %s\n", cell.label.c_str(),
                        cell.difference.mean_abs, cell.difference.max_abs, cell.difference.flip,
                        cell.compared_to.c_str());
}

Result<std::vector<Figure>> chosen_figures(const FiguresOptions& options) {
    DERMIS_TRY_ASSIGN(const Technique* technique,
                      find_technique(built_in_catalog().techniques, options.technique));
    return figures_of(*technique, options.only);
}

std::string sheet_path(const FiguresOptions& options, const Figure& figure) {
    return options.output + "/" + figure.id + ".png";
}

Result<FileUse> files_of(const FiguresOptions& options) {
    DERMIS_TRY_ASSIGN(const std::vector<Figure> figures, chosen_figures(options));
    FileUse files = {.outputs = {}, .inputs = {options.scene.name}};
    for (const Figure& figure : figures) files.outputs.emplace_back(sheet_path(options, figure));
    return files;
}

Result<int> make_figures(const FiguresOptions& options) {
    DERMIS_TRY(check_samples(options.samples));
    const Result<std::vector<Figure>> figures = chosen_figures(options);
    if (!figures) return figures.error();
    if (!options.scene.name.empty()) {
        DERMIS_TRY_ASSIGN(const Scene scene, options.scene.load());
        DERMIS_TRY(keep_scene_files(scene, files_of(options)));
    }
    const Result<std::vector<SceneWord>> words = options.scene.all_words();
    if (!words) return words.error();
    DERMIS_TRY_ASSIGN(const Font font, Font::load());
    DERMIS_TRY_ASSIGN(gpu::Device device, gpu::Device::create({.name_contains = options.device}));

    size_t cells = 0;
    for (const Figure& figure : *figures)
        for (const FigureRow& row : figure.rows) cells += row.cells.size();
    Progress progress("figures", cells);
    CellRenderer renderer(device, built_in_catalog(),
                          {.scene = options.scene.name,
                           .samples = options.samples,
                           .loading_words = words_for(*words, true),
                           .words = words_for(*words, false)});
    for (const Figure& figure : *figures) {
        DERMIS_TRY_ASSIGN(const FigureResult result,
                          draw_figure(renderer, font, figure, options.size, [&] { progress.advance(); }));
        ImageText text = {{"Software", "dermis"}, {"Description", figure.title + " (" + figure.source + ")"}};
        for (const std::string& credit : result.credits) text["Copyright"] = credit;
        const std::string path = sheet_path(options, figure);
        DERMIS_TRY(write_image(path, result.sheet, text));
        print(path, result);
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
    command->add_output("-o,--output", options->output, "directory; each figure is one PNG")
        ->capture_default_str();
    command->add_option("--size", options->size, {16, 2048}, "height of a cell in pixels")
        ->capture_default_str();
    command->add_option("--only", options->only, "draw only the figure with this id");
    command->add_option("--samples", options->samples, {1, 4}, "samples per pixel: 1 or 4")
        ->capture_default_str();
    command->add_option("--device", options->device, "use the Vulkan device with this text in its name");
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return make_figures(*options); });
}

}  // namespace dermis::cli
