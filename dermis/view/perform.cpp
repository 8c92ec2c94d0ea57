#include "dermis/view/perform.h"

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/view/motion.h"
#include "dermis/view/orbit.h"
#include "dermis/view/scene_edit.h"
#include "dermis/view/view_line.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

// The first free of dermis-001.png, dermis-002.png, ... in the directory the program runs in.
std::string free_name(const std::string& stem, const std::string& extension) {
    std::error_code ec;
    for (int number = 1;; ++number) {
        const std::string digits = std::to_string(number);
        const std::string zeros(digits.size() < 3 ? 3 - digits.size() : 0, '0');
        const std::string name = stem + "-" + zeros + digits + extension;
        if (!fs::exists(name, ec)) return name;
    }
}

void notify_written(Parts& p, const std::string& path, const Result<void>& written) {
    if (written)
        p.model.notices.inform("file", "written: " + fs::absolute(path).string(), p.clock.now_s());
    else
        p.model.notices.report_error("file", written.error().message);
}

// With step 0: back to the final picture where the technique lacks the view.
void choose_view(Model& model, int step) {
    model.view = neighbour(view_names(model.choices[0].technique()), model.view, step);
}

void choose_technique(Model& model, int step) {
    std::vector<std::string> ids;
    for (const Technique& technique : model.catalog.techniques) ids.push_back(technique.id);
    const Result<const Technique*> next =
        find_technique(model.catalog.techniques, neighbour(ids, model.choices[0].technique().id, step));
    if (next) model.choices[0].choose(**next);
    choose_view(model, 0);
}

void fit_head(Parts& p) {
    if (!p.model.scene) return;
    const PictureSize size = p.picture_size();
    fit(p.model.scene->camera, *p.model.scene, float(size.width) / float(size.height));
}

void reset_parameters(Parts& p) {
    TechniqueChoice& choice = p.model.choices[0];
    choice.values() = ParameterValues(choice.technique().parameters);
}

void add_exposure(Parts& p, float stops) {
    if (p.model.scene) p.model.scene->exposure_ev += stops;
}

void swap_sides(Parts& p) {
    if (!p.reference.texture()) std::swap(p.model.choices[0], p.model.choices[1]);
}

void copy_view(Parts& p) {
    if (!p.model.scene) return;
    const ShownScene& shown = p.pictures.scene();
    const PictureSize size = p.picture_size();
    const std::string line =
        view_line(p.model, shown.file_look(),
                  {.width = size.width, .height = size.height, .samples = shown.stage().samples()});
    p.window.set_clipboard(line);
    // Rounded as in the line, so that both draw the same; what the line leaves out of the camera is as the
    // files say.
    p.model.scene->camera = shown.file_look().camera;
    (void)apply_view_line(p.model, line);
    p.model.notices.inform("view", "copied: a command line that draws this picture", p.clock.now_s());
}

void paste_view(Parts& p) {
    if (!p.model.scene) return;
    const Result<void> pasted = p.pictures.scene().paste(p.window.clipboard(), p.model);
    p.model.notices.inform("view", pasted ? "pasted" : pasted.error().message, p.clock.now_s());
}

void save_shown_scene(Parts& p) {
    const std::string path = free_name(p.model.scene ? p.model.scene->name : "scene", ".toml");
    notify_written(p, path, save_scene(p, path));
}

// False, with a notice, without a scene that has its bakes.
bool has_whole_scene(Parts& p) {
    if (!p.pictures.scene().is_there()) return false;
    const bool lacks = p.pictures.scene().stage().lacks_bakes();
    if (lacks) p.model.notices.inform("file", "not before the scene is baked", p.clock.now_s());
    return !lacks;
}

void take_screenshot(Parts& p) {
    if (!has_whole_scene(p)) return;
    const std::string path = free_name("dermis", ".png");
    notify_written(p, path, p.pictures.scene().stage().write(p.model, 0, p.picture_size(), path));
}

void toggle_play(Parts& p) {
    if (p.model.playing) {
        p.model.playing = false;
        return;
    }
    if (const Result<void> played = play(p.model); !played)
        p.model.notices.inform("motion", played.error().message, p.clock.now_s());
}

// Begins in the folder of the shown scene.
void open_by_path(Parts& p) {
    if (p.model.open_field) return p.model.open_field.reset();
    std::error_code ec;
    const fs::path shown = p.model.scene_path;
    const std::string folder =
        fs::is_regular_file(shown, ec) ? fs::absolute(shown).parent_path().string() : "";
    p.model.open_field = OpenField{.text = folder.empty() ? "" : folder + "/"};
}

void dismiss(Parts& p) {
    p.model.show_help = false;
    p.model.notices.dismiss();
    p.model.open_field.reset();
}

void go_in_history(Parts& p, Result<bool> (History::*go)(Model&, ShownScene&), const char* nothing) {
    const Result<bool> gone = (p.history.*go)(p.model, p.pictures.scene());
    if (!gone)
        p.model.notices.report_error("history", gone.error().message);
    else if (!*gone)
        p.model.notices.inform("history", nothing, p.clock.now_s());
}

// The reference is of a moment.
void ask_reference(Parts& p) {
    if (!has_whole_scene(p)) return;
    p.model.playing = false;
    p.reference.ask(p.model, p.picture_size());
}

void toggle_vsync(Parts& p) {
    p.model.vsync = !p.model.vsync;
    p.model.notices.inform("vsync", p.model.vsync ? "waits for the display" : "does not wait for the display",
                           p.clock.now_s());
}

void scale_interface(Parts& p, float factor) {
    p.model.user_scale = std::clamp(p.model.user_scale * factor, 0.5f, 3.0f);
}

struct Performer {
    Action action;
    void (*perform)(Parts& p);
};

constexpr Performer kPerformers[] = {
    {Action::none, [](Parts&) {}},
    {Action::help, [](Parts& p) { p.model.show_help = !p.model.show_help; }},
    {Action::panels, [](Parts& p) { p.model.show_panels = !p.model.show_panels; }},
    {Action::fit, fit_head},
    {Action::next_technique, [](Parts& p) { choose_technique(p.model, 1); }},
    {Action::last_technique, [](Parts& p) { choose_technique(p.model, -1); }},
    {Action::next_view, [](Parts& p) { choose_view(p.model, 1); }},
    {Action::last_view, [](Parts& p) { choose_view(p.model, -1); }},
    {Action::final_view, [](Parts& p) { p.model.view = "final"; }},
    {Action::reset_parameters, reset_parameters},
    {Action::brighter, [](Parts& p) { add_exposure(p, 1.0f / 3); }},
    {Action::darker, [](Parts& p) { add_exposure(p, -1.0f / 3); }},
    {Action::compare, [](Parts& p) { p.model.compare = Compare((int(p.model.compare) + 1) % 3); }},
    {Action::swap_sides, swap_sides},
    {Action::reference, ask_reference},
    {Action::play, toggle_play},
    {Action::open, open_by_path},
    {Action::undo, [](Parts& p) { go_in_history(p, &History::undo, "nothing to undo"); }},
    {Action::redo, [](Parts& p) { go_in_history(p, &History::redo, "nothing to redo"); }},
    {Action::copy_view, copy_view},
    {Action::paste_view, paste_view},
    {Action::save_scene, save_shown_scene},
    {Action::screenshot, take_screenshot},
    {Action::vsync, toggle_vsync},
    {Action::dismiss, dismiss},
    {Action::larger_interface, [](Parts& p) { scale_interface(p, 1.125f); }},
    {Action::smaller_interface, [](Parts& p) { scale_interface(p, 1 / 1.125f); }},
    {Action::quit, [](Parts& p) { p.quit = true; }},
};

constexpr bool has_every_action_in_order() {
    for (size_t i = 0; i < std::size(kPerformers); ++i)
        if (kPerformers[i].action != Action(i)) return false;
    return std::size(kPerformers) == size_t(Action::quit) + 1;
}
static_assert(has_every_action_in_order());

}  // namespace

void perform(Parts& parts, Action action) {
    kPerformers[size_t(action)].perform(parts);
}

Result<void> save_scene(Parts& parts, const std::string& path) {
    if (!parts.model.scene) return Error{"no scene to save yet"};
    const Result<std::string> text = scene_text(parts.model, fs::absolute(path).parent_path());
    return text ? write_text_file(path, *text) : text.error();
}

}  // namespace dermis::view
