#include "dermis/view/script_commands.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/scene/part_words.h"
#include "dermis/scene/scene_words.h"
#include "dermis/view/head_words.h"
#include "dermis/view/motion.h"
#include "dermis/view/perform.h"

namespace dermis::view {
namespace {

// The resident memory of the process; 0 where /proc does not tell.
long memory_mb() {
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * sysconf(_SC_PAGESIZE) / (1024 * 1024);
}

std::string environment_text(const Environment& environment) {
    if (environment.kind == EnvironmentKind::file) return environment.file.string();
    return environment.kind == EnvironmentKind::studio ? "studio" : "none";
}

// The output of `print`, one property per line.
std::string state_text(Parts& p) {
    Model& model = p.model;
    TechniqueChoice& choice = model.choices[0];
    std::string text = "scene " + model.scene_path + "\ntechnique " + choice.technique().id + "\n";
    for (const Parameter& parameter : choice.technique().parameters.parameters)
        text += "set " + parameter.name + "=" + choice.values().text(parameter) + "\n";
    if (model.compares())
        text += "right " + (p.reference.texture() ? model.reference_path : model.choices[1].technique().id) +
                "\n";
    if (model.reference_is_of_another_view) text += "stale reference\n";
    for (const HeadMesh& mesh : meshes_of(*model.scene))
        text += "unit_mm " + mesh.name + " " + to_text(float(mesh.unit_mm)) + "\n";
    for (const HeadMaterial& material : materials_of(*model.scene))
        text += "material " + material.name + " " + part_name(material.part) +
                (material.visible ? "" : " hidden") +
                (material.profile.empty() ? "" : " profile " + material.profile) + "\n";
    text += "tone " + std::to_string(model.tone) + "\nprofile " + model.scene->skin.profile + "\n";
    text += "view " + model.view + "\ncamera " + camera_text(model.scene->camera) + "\n";
    const auto key = std::ranges::find(model.scene->lights, true, &Light::is_key);
    if (key != model.scene->lights.end()) text += "light " + light_text(*key) + "\n";
    text += "environment " + environment_text(model.scene->environment) + "\n";
    if (has_motion(*model.scene)) text += motion_text(model);
    text += "exposure_ev " + to_text(model.scene->exposure_ev) + "\n";
    const WindowSize size = p.presenter->size();
    text += "window " + std::to_string(size.width) + "x" + std::to_string(size.height) + "\n";
    const Picture& picture = p.pictures.scene().stage().picture(0);
    text += "picture " + std::to_string(picture.width) + "x" + std::to_string(picture.height) + " " +
            std::to_string(picture.quality.samples) + "\npasses " + std::to_string(picture.passes) + "\n";
    text += std::string("minimised ") + (p.window.framebuffer().width == 0 ? "yes\n" : "no\n");
    text += "interface_scale " + to_text(p.interface->scale()) + "\n";
    const gpu::Footprint held = p.presenter->footprint();
    text += "window_images " + std::to_string(held.images) + "\n";
    text += "pipelines " + std::to_string(held.pipelines) + "\n";
    text += "frame " + std::to_string(p.clock.frames()) + "\n";
    text += "device_objects " + std::to_string(p.device.created_objects()) + "\n";
    text += "memory_mb " + std::to_string(memory_mb()) + "\n";
    text += "clipboard " + p.window.clipboard() + "\n";
    for (const std::string& warning : model.warnings.unread()) text += "warning " + warning + "\n";
    for (const Notice& notice : model.notices.all()) text += "notice " + notice.text + "\n";
    return text;
}

using Command = const ScriptCommand&;

Result<void> open_scene(Parts& p, Command command) {
    p.opener.load(command.words[0]);
    return {};
}

Result<void> use_technique(Parts& p, Command command) {
    DERMIS_TRY_ASSIGN(const Technique* technique,
                      find_technique(p.model.catalog.techniques, command.words[0]));
    p.model.choices[0].choose(*technique);
    return {};
}

Result<void> set_parameter(Parts& p, Command command) {
    return p.model.choices[0].values().set_all(std::span(command.words).first(1));
}

Result<void> use_view(Parts& p, Command command) {
    const std::vector<std::string> views = view_names(p.model.choices[0].technique());
    if (!std::ranges::count(views, command.words[0]))
        return Error{unknown_name("view", command.words[0], views)};
    p.model.view = command.words[0];
    return {};
}

Result<void> use_tone(Parts& p, Command command) {
    const double tone = command.numbers[0];
    if (tone != int(tone) || tone < 0 || tone > 6) return Error{"tone: 0 (as the maps are) to 6"};
    p.pictures.scene().choose_tone(int(tone), p.model);
    return {};
}

Result<void> use_clip(Parts& p, Command command) {
    MotionDescription motion = p.model.scene->motion;
    motion.clip = command.words[0];
    motion.time_s = 0;
    return set_motion(*p.model.scene, std::move(motion));
}

Result<void> use_time(Parts& p, Command command) {
    if (command.numbers[0] < 0) return Error{"time: 0 seconds or more"};
    p.model.scene->motion.time_s = command.numbers[0];
    return {};
}

Result<void> use_morph(Parts& p, Command command) {
    MotionDescription motion = p.model.scene->motion;
    motion.morph[command.words[0]] = float(command.numbers[0]);
    return set_motion(*p.model.scene, std::move(motion));
}

Result<void> change_scene(Parts& p, Command command) {
    const std::string& word = command.words[0];
    if (word.find('"') != word.npos) return Error{"scene: " + word + ": write it without quotation marks"};
    return p.pictures.scene().paste("--scene \"" + word + "\"", p.model);
}

Result<Region> visible_widget(const Parts& p, Command command) {
    const auto widget = p.widgets.find(command.words[0]);
    std::vector<std::string> names;
    for (const auto& [name, region] : p.widgets) names.push_back(name);
    if (widget == p.widgets.end()) return Error{unknown_name("widget", command.words[0], names)};
    if (widget->second.y + widget->second.height > float(p.presenter->size().height))
        return Error{command.words[0] + " is not visible; make the window higher"};
    return widget->second;
}

Result<void> slide_widget(Parts& p, Command command) {
    DERMIS_TRY_ASSIGN(const Region widget, visible_widget(p, command));
    p.input.play(slide_frames(widget, command.numbers[0]));
    return {};
}

Result<void> click_widget(Parts& p, Command command) {
    DERMIS_TRY_ASSIGN(const Region widget, visible_widget(p, command));
    p.input.play(click_frames(widget));
    return {};
}

Result<void> copy_file(Parts&, Command command) {
    const Result<std::vector<std::byte>> bytes = read_file(command.words[0]);
    return bytes ? write_file(command.words[1], *bytes) : bytes.error();
}

Result<void> resize_window(Parts& p, Command command) {
    p.window.resize({int(command.numbers[0]), int(command.numbers[1])});
    p.input.play(std::deque<std::vector<Event>>(3));  // frames for the display to answer
    return {};
}

Result<void> wait_until_settled(Parts& p, Command) {
    if (p.model.playing)
        return Error{"settle: the clip plays, so no picture is the last; write pause before"};
    p.player.settle();
    p.pictures.await_refresh();
    return {};
}

Result<void> print_state(Parts& p, Command) {
    if (p.options.print) p.options.print(state_text(p));
    return {};
}

// For commands that cannot fail.
template <auto Run>
Result<void> always(Parts& p, Command command) {
    Run(p, command);
    return {};
}

struct Runner {
    CommandKind kind;
    Result<void> (*run)(Parts& p, Command command);
};

// Commands that are not listed are input: drag, scroll, key, type, drop, wait.
constexpr Runner kRunners[] = {
    {CommandKind::open, open_scene},
    {CommandKind::technique, use_technique},
    {CommandKind::set, set_parameter},
    {CommandKind::view, use_view},
    {CommandKind::tone, use_tone},
    {CommandKind::scene, change_scene},
    {CommandKind::clip, use_clip},
    {CommandKind::time, use_time},
    {CommandKind::play, [](Parts& p, Command) { return play(p.model); }},
    {CommandKind::pause, always<[](Parts& p, Command) { p.model.playing = false; }>},
    {CommandKind::morph, use_morph},
    {CommandKind::slide, slide_widget},
    {CommandKind::click, click_widget},
    {CommandKind::undo, always<[](Parts& p, Command) { perform(p, Action::undo); }>},
    {CommandKind::redo, always<[](Parts& p, Command) { perform(p, Action::redo); }>},
    {CommandKind::copy, copy_file},
    {CommandKind::save, [](Parts& p, Command c) { return save_scene(p, c.words[0]); }},
    {CommandKind::clipboard, always<[](Parts& p, Command c) { p.window.set_clipboard(c.words[0]); }>},
    {CommandKind::resize, resize_window},
    {CommandKind::minimise, always<[](Parts& p, Command) { p.window.minimise(); }>},
    {CommandKind::restore, always<[](Parts& p, Command) { p.window.restore(); }>},
    {CommandKind::settle, wait_until_settled},
    {CommandKind::screenshot,
     [](Parts& p, Command c) {
         return p.pictures.scene().stage().write(p.model, 0, p.picture_size(), c.words[0]);
     }},
    {CommandKind::capture, [](Parts& p, Command c) { return p.presenter->capture(c.words[0]); }},
    {CommandKind::lose_device,
     [](Parts&, Command) -> Result<void> {
         return Error{"the GPU was lost, as the script says", ErrorCode::device_lost};
     }},
    {CommandKind::print, print_state},
    {CommandKind::quit, always<[](Parts& p, Command) { p.quit = true; }>},
};

}  // namespace

Result<void> run_command(Parts& parts, const ScriptCommand& command) {
    const auto runner = std::ranges::find(kRunners, command.kind, &Runner::kind);
    if (runner != std::end(kRunners)) return runner->run(parts, command);
    parts.input.play(input_frames(command));
    return {};
}

}  // namespace dermis::view
