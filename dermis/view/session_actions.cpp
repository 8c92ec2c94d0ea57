// What keys, panels and dropped files ask for.

#include <algorithm>
#include <filesystem>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/render/shared_passes.h"
#include "dermis/view/orbit.h"
#include "dermis/view/scene_edit.h"
#include "dermis/view/session.h"
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

}  // namespace

void Session::open_file(const std::string& path) {
    const std::string extension = to_lower(fs::path(path).extension().string());
    if (extension == ".hdr") return open_panorama(path);
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") return truth_.open(path, model_);
    if (extension != ".exr") return load(path);
    // Twice as wide as high is a panorama; anything else is a rendered picture.
    const Result<LoadedImage> loaded = read_image(path, ImageUse::color);
    if (!loaded) return model_.notices.report_error("open", loaded.error().message);
    if (loaded->image.width == 2 * loaded->image.height) return open_panorama(path);
    truth_.open(path, model_);
}

void Session::open_panorama(const std::string& path) {
    if (!model_.scene) return;
    const Result<void> opened = shown_.open_panorama(path);
    if (!opened) return model_.notices.report_error("open", opened.error().message);
    loader_.follow_too({path});
    model_.notices.inform("open", "environment: " + path, now_s());
}

void Session::copy_view() {
    if (!model_.scene) return;
    const PictureSize size = picture_size();
    const std::string line =
        view_line(model_, shown_.file_look(),
                  {.width = size.width, .height = size.height, .samples = shown_.stage().samples()});
    window_.set_clipboard(line);
    (void)apply_view_line(model_, line);  // rounded as the line is, so that both draw the same
    model_.notices.inform("view", "copied: a command line that draws this picture", now_s());
}

void Session::paste_view() {
    if (!model_.scene) return;
    const Result<void> pasted = shown_.paste(window_.clipboard(), model_);
    model_.notices.inform("view", pasted ? "pasted" : pasted.error().message, now_s());
}

Result<void> Session::save_scene(const std::string& path) {
    if (!model_.scene) return Error{"no scene to save yet"};
    const Result<std::string> text = scene_text(model_, fs::absolute(path).parent_path());
    return text ? write_text_file(path, *text) : text.error();
}

void Session::notify_written(const std::string& path, const Result<void>& written) {
    if (written)
        model_.notices.inform("file", "written: " + fs::absolute(path).string(), now_s());
    else
        model_.notices.report_error("file", written.error().message);
}

void Session::act(Action action) {
    Scene* scene = model_.scene;
    switch (action) {
        case Action::none:
            return;
        case Action::help:
            model_.show_help = !model_.show_help;
            return;
        case Action::panels:
            model_.show_panels = !model_.show_panels;
            return;
        case Action::fit:
            if (scene) fit(scene->camera, *scene, float(picture_size().width) / float(picture_size().height));
            return;
        case Action::next_technique:
            return choose_technique(model_, 1);
        case Action::last_technique:
            return choose_technique(model_, -1);
        case Action::next_view:
            return choose_view(model_, 1);
        case Action::last_view:
            return choose_view(model_, -1);
        case Action::final_view:
            model_.view = "final";
            return;
        case Action::reset_parameters:
            model_.choices[0].values() = ParameterValues(model_.choices[0].technique().parameters);
            return;
        case Action::brighter:
        case Action::darker:
            if (scene) scene->exposure_ev += (action == Action::brighter ? 1.0f : -1.0f) / 3;
            return;
        case Action::compare:
            model_.compare = Compare((int(model_.compare) + 1) % 3);
            return;
        case Action::swap_sides:
            if (!truth_.texture()) std::swap(model_.choices[0], model_.choices[1]);
            return;
        case Action::ground_truth:
            return truth_.ask(model_, picture_size());
        case Action::copy_view:
            return copy_view();
        case Action::paste_view:
            return paste_view();
        case Action::save_scene: {
            const std::string path = free_name(scene ? scene->name : "scene", ".toml");
            return notify_written(path, save_scene(path));
        }
        case Action::screenshot: {
            if (!shown_.is_there()) return;
            const std::string path = free_name("dermis", ".png");
            return notify_written(path, shown_.stage().write(model_, 0, picture_size(), path));
        }
        case Action::vsync:
            model_.vsync = !model_.vsync;
            presenter_->set_vsync(model_.vsync);
            model_.notices.inform(
                "vsync", model_.vsync ? "waits for the display" : "does not wait for the display", now_s());
            return;
        case Action::dismiss:
            return model_.notices.dismiss();
        case Action::larger_interface:
        case Action::smaller_interface:
            model_.user_scale = std::clamp(
                model_.user_scale * (action == Action::larger_interface ? 1.125f : 1 / 1.125f), 0.5f, 3.0f);
            return;
        case Action::quit:
            quit_ = true;
            return;
    }
}

}  // namespace dermis::view
