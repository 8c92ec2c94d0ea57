// What a script asks for.

#include <sys/resource.h>

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/render/shared_passes.h"
#include "dermis/scene/scene_words.h"
#include "dermis/view/session.h"

namespace dermis::view {
namespace {

// The most that the process has held in memory so far.
long peak_memory_mb() {
    rusage usage = {};
    return getrusage(RUSAGE_SELF, &usage) == 0 ? usage.ru_maxrss / 1024 : 0;
}

}  // namespace

Result<void> Session::step_script() {
    if (input_.is_playing() || loader_.is_loading() || !shown_.is_there()) return {};
    const ScriptCommand* command = player_.next(is_settled());
    if (!command) return {};
    const Result<void> done = run_command(*command);
    return done ? done : player_.error_at(*command, done.error());
}

Result<void> Session::run_command(const ScriptCommand& command) {
    switch (command.kind) {
        case CommandKind::open:
            load(command.words[0]);
            return {};
        case CommandKind::technique: {
            const Result<const Technique*> technique =
                find_technique(model_.catalog.techniques, command.words[0]);
            if (!technique) return technique.error();
            model_.choices[0].choose(**technique);
            return {};
        }
        case CommandKind::set: {
            const std::string& word = command.words[0];
            const size_t equals = std::min(word.find('='), word.size());
            return model_.choices[0].values().set(word.substr(0, equals),
                                                  word.substr(std::min(equals + 1, word.size())));
        }
        case CommandKind::view: {
            const std::vector<std::string> views = view_names(model_.choices[0].technique());
            if (!std::ranges::count(views, command.words[0]))
                return Error{unknown_name("view", command.words[0], views)};
            model_.view = command.words[0];
            return {};
        }
        case CommandKind::tone:
            if (command.numbers[0] != int(command.numbers[0]) || command.numbers[0] < 0 ||
                command.numbers[0] > 6)
                return Error{"tone: 0 (as the maps are) to 6"};
            shown_.choose_tone(int(command.numbers[0]), model_);
            return {};
        case CommandKind::slide: {
            const auto widget = widgets_.find(command.words[0]);
            std::vector<std::string> names;
            for (const auto& [name, region] : widgets_) names.push_back(name);
            if (widget == widgets_.end()) return Error{unknown_name("widget", command.words[0], names)};
            if (widget->second.y + widget->second.height > float(presenter_->size().height))
                return Error{command.words[0] + " is not visible; make the window higher"};
            input_.play(slide_frames(widget->second, command.numbers[0]));
            return {};
        }
        case CommandKind::copy: {
            const Result<std::vector<std::byte>> bytes = read_file(command.words[0]);
            return bytes ? write_file(command.words[1], *bytes) : bytes.error();
        }
        case CommandKind::save:
            return save_scene(command.words[0]);
        case CommandKind::clipboard:
            window_.set_clipboard(command.words[0]);
            return {};
        case CommandKind::resize:
            window_.resize({int(command.numbers[0]), int(command.numbers[1])});
            input_.play(std::deque<std::vector<Event>>(3));  // the display answers in its own time
            return {};
        case CommandKind::minimise:
            window_.minimise();
            return {};
        case CommandKind::restore:
            window_.restore();
            return {};
        case CommandKind::settle:
            player_.settle();
            drew_ = true;  // at least one more frame
            return {};
        case CommandKind::screenshot:
            return shown_.stage().write(model_, 0, picture_size(), command.words[0]);
        case CommandKind::capture:
            return presenter_->capture(command.words[0]);
        case CommandKind::lose_device:
            return Error{"the GPU was lost, as the script says", ErrorCode::device_lost};
        case CommandKind::print:
            if (options_->print) options_->print(state_text());
            return {};
        case CommandKind::quit:
            quit_ = true;
            return {};
        default:
            input_.play(input_frames(command));
            return {};
    }
}

std::string Session::state_text() {
    TechniqueChoice& choice = model_.choices[0];
    std::string text = "scene " + model_.scene_path + "\ntechnique " + choice.technique().id + "\n";
    for (const Parameter& parameter : choice.technique().parameters.parameters)
        text += "set " + parameter.name + "=" + choice.values().text(parameter) + "\n";
    if (model_.compares())
        text += "right " + (truth_.texture() ? model_.truth_path : model_.choices[1].technique().id) + "\n";
    if (model_.truth_is_of_another_view) text += "stale truth\n";
    text += "profile " + model_.scene->skin.profile + "\n";
    text += "view " + model_.view + "\ncamera " + camera_text(model_.scene->camera) + "\n";
    const auto key = std::ranges::find(model_.scene->lights, true, &Light::is_key);
    if (key != model_.scene->lights.end()) text += "light " + light_text(*key) + "\n";
    const Environment& around = model_.scene->environment;
    const bool from_file = around.kind == EnvironmentKind::file;
    text += "environment " +
            (from_file                                ? around.file.string()
             : around.kind == EnvironmentKind::studio ? std::string("studio")
                                                      : std::string("none")) +
            "\n";
    text += "exposure_ev " + to_text(model_.scene->exposure_ev) + "\n";
    const WindowSize size = presenter_->size();
    text += "window " + std::to_string(size.width) + "x" + std::to_string(size.height) + "\n";
    const Picture& picture = shown_.stage().picture(0);
    text += "picture " + std::to_string(picture.width) + "x" + std::to_string(picture.height) + " " +
            std::to_string(picture.quality.samples) + "\npasses " +
            std::to_string(picture.timings.passes.size()) + "\n";
    text += std::string("minimised ") + (window_.framebuffer().width == 0 ? "yes\n" : "no\n");
    text += "interface_scale " + to_text(interface_->scale()) + "\n";
    const gpu::Footprint held = presenter_->footprint();
    text += "window_images " + std::to_string(held.images) + "\n";
    text += "peak_memory_mb " + std::to_string(peak_memory_mb()) + "\n";
    text += "clipboard " + window_.clipboard() + "\n";
    for (const Notice& notice : model_.notices.all()) text += "notice " + notice.text + "\n";
    return text;
}

}  // namespace dermis::view
