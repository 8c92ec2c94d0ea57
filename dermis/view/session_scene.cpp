// What is loaded, and what follows when its files change.

#include <algorithm>

#include "dermis/scene/scene_files.h"
#include "dermis/view/scene_look.h"
#include "dermis/view/session.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

constexpr double kLookEveryS = 0.3;
constexpr const char* kShaderTopic = "shader ";
constexpr const char* kLastGood = "  (the last version without an error stays in use)";

// The baseline, or against the baseline the technique after it.
const Technique& compared_with(const Technique& technique, std::span<const Technique> all) {
    const auto baseline = std::ranges::find(all, "lambert", &Technique::id);
    if (baseline != all.end() && technique.id != baseline->id) return *baseline;
    return all[1 % all.size()];
}

}  // namespace

void Session::load(const std::string& path) {
    const bool same = path == model_.scene_path;
    if (!loader_.load(path, same ? model_.loading_words : std::vector<SceneWord>()))
        model_.notices.inform("open", "still loading " + loader_.path(), now_s());
}

Result<void> Session::take_loaded() {
    std::optional<Result<Start>> start = loader_.take();
    if (!start) return {};
    const bool first = !shown_.is_there();
    const Result<void> begun = *start ? begin_scene(std::move(**start), first) : start->error();
    if (begun || first) return begun;
    if (loader_.is_reload()) loader_.follow_stated_files();  // what it waits for may be missing
    model_.notices.report_error("open", begun.error().message + (loader_.is_reload() ? kLastGood : ""));
    return {};
}

Result<void> Session::begin_scene(Start start, bool first) {
    auto scene = std::make_unique<Scene>(std::move(start.scene));
    Scene file = start.file_look.value_or(without_objects(*scene));
    if (loader_.is_reload()) {
        if (loader_.file_changed())
            keep_look(shown_.file_look(), *model_.scene, *scene);
        else
            put_look(*model_.scene, *scene);
        loader_.follow_too(files_of(*scene));  // also when it cannot be drawn
    }
    Result<Stage> stage = Stage::create(device_, shaders_.source(), std::move(scene), options_->samples);
    if (!stage) return stage.error();
    if (first) take_start(start);
    if (!first) take_technique(file);
    shown_.put(std::move(*stage), std::move(file), model_);
    model_.scene_path = loader_.path();
    model_.loading_words = std::move(start.loading_words);
    const bool same_tone = model_.scene->skin.profile == tone_profile(model_.tone);
    if (!same_tone || (!loader_.is_reload() && !start.handed)) model_.tone = 0;
    if (loader_.is_reload() && model_.tone > 0) shown_.choose_tone(model_.tone, model_);  // another mean
    loader_.follow(*model_.scene);
    announce_scene();
    return {};
}

// What the window opens with, or what one whose device was lost has left.
void Session::take_start(const Start& start) {
    if (start.handed) {
        model_ = start.handed->model;
        model_.notices = {};
        presenter_->set_vsync(model_.vsync);
        truth_.take_over(start.handed->truth, start.handed->truth_view);
        return;
    }
    if (start.technique) {
        model_.choices[0].choose(*start.technique);
        if (start.values) model_.choices[0].values() = *start.values;
        model_.choices[1].choose(compared_with(*start.technique, model_.catalog.techniques));
    }
    model_.view = start.view;
    if (!options_->truth.empty()) truth_.open(options_->truth, model_);
}

// What the scene's file asks for; of one that is only read again, what it asks for anew.
void Session::take_technique(const Scene& file) {
    const Scene& before = shown_.file_look();
    const bool asks_anew =
        !loader_.is_reload() || file.technique != before.technique || file.settings != before.settings;
    if (file.technique.empty() || !asks_anew) return;
    const Result<const Technique*> technique = find_technique(model_.catalog.techniques, file.technique);
    if (!technique) return model_.notices.report_error("technique", technique.error().message);
    model_.choices[0].choose(**technique);
    model_.notices.clear("technique");
    for (const auto& [name, text] : file.settings)
        if (const Result<void> set = model_.choices[0].values().set(name, text); !set)
            model_.notices.report_error("technique", set.error().message);
}

// Remembers the scene, and says what its files lack.
void Session::announce_scene() {
    remember(state_, model_.scene_path);
    model_.recent = state_.recent;
    model_.notices.clear("open");
    for (const std::string& warning : model_.scene->warnings)
        model_.notices.inform("warning", warning, now_s());
    window_.set_title(model_.scene->name + " - Dermis");
}

// A panorama is read again alone; anything else is the whole scene, beside the window's work.
bool Session::follow_scene_files() {
    const std::vector<fs::path> changed = loader_.changed_files();
    if (changed.empty()) return false;
    const Environment& around = model_.scene->environment;
    if (around.kind == EnvironmentKind::file && changed == std::vector{around.file}) {
        const Result<void> read = shown_.stage().environment_changed();
        model_.notices.clear("environment");
        if (!read) model_.notices.report_error("environment", read.error().message + kLastGood);
        return true;
    }
    load(model_.scene_path);
    loader_.expect_same_scene(std::ranges::any_of(changed, is_scene_file));
    return true;
}

bool Session::follow_files() {
    bool changed = false;
    if (now_s() - last_look_s_ >= kLookEveryS) {
        last_look_s_ = now_s();
        if (shaders_.poll() && shown_.is_there()) {
            shown_.stage().forget_shaders();
            shaders_unproven_ = changed = true;
        }
        if (shown_.is_there() && !loader_.is_loading()) changed |= follow_scene_files();
    }
    const std::vector<Notice> shown = model_.notices.all();
    for (const Notice& notice : shown)
        if (notice.topic.starts_with(kShaderTopic)) model_.notices.clear(notice.topic);
    for (const auto& [name, message] : shaders_.errors())
        model_.notices.report_error(kShaderTopic + name, message + kLastGood);
    return changed;
}

}  // namespace dermis::view
