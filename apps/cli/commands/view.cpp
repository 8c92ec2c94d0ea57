// dermis view: the techniques in a window.

#include <array>
#include <cstdio>
#include <memory>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "dermis/view/state_file.h"
#include "dermis/view/viewer.h"
#include "render_options.h"
#include "turntable.h"

namespace dermis::cli {
namespace {

struct ViewOptions {
    RenderOptions render;
    Turntable turntable;
    std::string script, reference, shader_root;
    int frames = 0, turn_frames = 0;
    float interface_scale = 0;
};

Turntable turntable_of(const ViewOptions& options) {
    Turntable turntable = options.turntable;
    turntable.render = options.render;
    turntable.frames = options.turn_frames;
    if (turntable.render.size.empty()) turntable.render.size = "1024x1024";
    return turntable;
}

Result<std::vector<view::ScriptCommand>> read_script(const std::string& name) {
    if (name.empty()) return std::vector<view::ScriptCommand>{};
    DERMIS_TRY_ASSIGN(const std::string text, read_text_file(name));
    return view::parse_script(text, name);
}

// A script may save the scene that it shows, as Ctrl+S does.
Result<FileUse> files_of_window(const ViewOptions& options) {
    if (options.turntable.output != Turntable{}.output)
        return Error{"-o has no effect without --turntable, which writes pictures"};
    std::error_code ec;
    const std::filesystem::path shaders = options.shader_root;
    if (!shaders.empty() && !std::filesystem::is_directory(shaders / "shaders", ec))
        return Error{"--shaders " + options.shader_root + ": has no folder shaders/"};
    DERMIS_TRY_ASSIGN(const std::vector<view::ScriptCommand> script, read_script(options.script));
    FileUse files = view::script_files(script);
    std::erase(files.outputs, std::filesystem::path(options.render.scene.name));
    files.inputs = {options.script, options.reference, options.render.scene.name};
    return files;
}

Result<FileUse> files_of(const ViewOptions& options) {
    if (options.turn_frames == 0) return files_of_window(options);
    for (const auto& [flag, given] :
         {std::pair("--script", !options.script.empty()),
          std::pair("--reference", !options.reference.empty()), std::pair("--frames", options.frames != 0)})
        if (given) return Error{std::string(flag) + " has no effect on --turntable, which opens no window"};
    return turntable_files(turntable_of(options));
}

// Keeps the scene of the files apart from the changes by --scene, --camera and --light, which stay when the
// files change.
Result<view::Start> first_scene(const ViewOptions& options) {
    DERMIS_TRY_ASSIGN(Prepared prepared, prepare_unbaked(options.render));
    DERMIS_TRY(keep_scene_files(prepared.scene, files_of_window(options)));
    const Result<std::vector<SceneWord>> words = options.render.scene.all_words();
    return view::Start{.scene = std::move(prepared.scene),
                       .lacks_bakes = true,
                       .loading_words = words_for(*words, true),
                       .technique = prepared.technique,
                       .values = std::move(prepared.values),
                       .view = prepared.draw.view,
                       .file_look = std::move(prepared.as_filed)};
}

std::string first_picture_text(const view::ViewerReport& report) {
    if (!report.first_picture_s) return "closed before the first picture";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "first picture after %.2f s", *report.first_picture_s);
    return text.data();
}

Result<int> view_scene(ViewOptions options) {
    if (options.turn_frames != 0) return run_turntable(turntable_of(options));
    if (options.render.size.empty()) {
        const view::WindowState state = view::load_state();
        options.render.size = std::to_string(state.width) + "x" + std::to_string(state.height);
    }
    const Result<Size> size = parse_size(options.render.size);
    if (!size) return size.error();
    view::ViewerOptions viewer = {.catalog = built_in_catalog(),
                                  .scene_path = options.render.scene.name,
                                  .load = [&options] { return first_scene(options); },
                                  .size = {size->width, size->height},
                                  .device = options.render.device,
                                  .validation = options.render.validation,
                                  .on_message = print_message,
                                  .samples = options.render.samples,
                                  .interface_scale = options.interface_scale,
                                  .frames = options.frames,
                                  .shader_root = options.shader_root,
                                  .reference = options.reference,
                                  .script_name = options.script,
                                  .print = [](const std::string& text) { std::printf("%s", text.c_str()); }};
    if (!options.reference.empty())
        if (const Result<LoadedImage> picture = read_image(options.reference, ImageUse::color); !picture)
            return picture.error().within("--reference");
    DERMIS_TRY_ASSIGN(viewer.script, read_script(options.script));
    DERMIS_TRY_ASSIGN(const view::ViewerReport report, view::run_viewer(viewer));
    if (options.frames > 0 || !options.script.empty())
        std::printf("%d frames, %s on %s\n", report.frames, first_picture_text(report).c_str(),
                    report.device.c_str());
    return 0;
}

}  // namespace

void add_view_command(CommandLine& line) {
    const auto options = std::make_shared<ViewOptions>();
    options->render.size = "";  // the size of the last window
    options->render.samples = 4;
    Command* command = line.add("view", "Shows a scene in a window, in real time; F1 lists the keys",
                                "dermis view head_scan --technique preintegrated");
    options->render.add_to(*command);
    command->add_option("--interface-scale", options->interface_scale, {0.25, 8},
                        "factor on the size of text and controls (default: from the display)");
    command->add_option("--reference", options->reference,
                        "picture to compare with, for example one of dermis reference");
    command->add_option("--turntable", options->turn_frames, {1, 100000},
                        "no window: write one full turn of the camera in this number of frames");
    command
        ->add_output("-o,--output", options->turntable.output,
                     "output of --turntable: numbered pictures (out/%04d.png) or a video (.mp4)")
        ->capture_default_str();
    command->add_option("--shaders", options->shader_root,
                        "folder with shaders/ and techniques/ to watch (default: the source tree)");
    command->add_option("--frames", options->frames, {1, 1e9}, "close after this number of frames");
    command->add_option("--script", options->script,
                        "UI script: simulated mouse and keyboard (docs/view.md)");
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return view_scene(*options); });
}

}  // namespace dermis::cli
