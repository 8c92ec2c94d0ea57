// What is loaded, and what follows when its files change.

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_paths.h"
#include "dermis/view/scene_look.h"
#include "dermis/view/session.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

constexpr double kLookEveryS = 0.3;
constexpr const char* kShaderTopic = "shader ";
constexpr const char* kLastGood = "  (the last good one goes on)";

bool is_scene(const fs::path& file) {
    return to_lower(file.extension().string()) == ".toml";
}

// What a scene file names, there or not.
std::vector<fs::path> stated_files(const std::string& path_or_name, std::span<const Subject> subjects) {
    const fs::path file = is_scene(path_or_name) ? fs::path(path_or_name) : find_scene(path_or_name);
    const Result<std::string> text = read_text_file(file);
    const Result<SceneDescription> description = text ? parse_scene(*text, file, subjects) : text.error();
    return description ? paths_of(*description) : std::vector<fs::path>();
}

// The baseline, or against the baseline the technique after it.
const Technique& compared_with(const Technique& technique, std::span<const Technique> all) {
    const auto baseline = std::ranges::find(all, "lambert", &Technique::id);
    if (baseline != all.end() && technique.id != baseline->id) return *baseline;
    return all[1 % all.size()];
}

// A scene, ready to draw.
Result<Start> load_start(const std::string& path, std::span<const Subject> subjects,
                         const std::vector<SceneWord>& words) {
    Result<Scene> scene = load_scene(path, {.subjects = subjects, .words = words});
    if (!scene) return scene.error();
    if (Result<void> completed = complete_scene(*scene); !completed) return completed.error();
    return Start{.scene = std::move(*scene), .loading_words = words};
}

}  // namespace

void Session::load(const std::string& path) {
    if (loading_.valid()) return model_.notices.inform("open", "still loading " + loading_path_, now_s());
    loading_path_ = path;
    reloading_ = false;
    loading_ = std::async(std::launch::async, load_start, path, model_.catalog.subjects,
                          path == model_.scene_path ? model_.loading_words : std::vector<SceneWord>());
}

Result<void> Session::take_loaded() {
    if (!loading_.valid()) return {};
    if (loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
    const bool first = !stage_;
    Result<Start> start = loading_.get();
    const Result<void> begun = start ? begin_scene(std::move(*start), first) : start.error();
    if (begun || first) return begun;
    if (reloading_)
        scene_files_.add(
            stated_files(loading_path_, model_.catalog.subjects));  // what it waits for may be missing
    model_.notices.complain("open", begun.error().message + (reloading_ ? kLastGood : ""));
    return {};
}

Result<void> Session::begin_scene(Start start, bool first) {
    auto scene = std::make_unique<Scene>(std::move(start.scene));
    const Scene file_look = start.file_look.value_or(without_objects(*scene));
    if (reloading_) {
        if (scene_file_changed_)
            keep_look(file_look_, *model_.scene, *scene);
        else
            put_look(*model_.scene, *scene);
        scene_files_.add(files_of(*scene));  // also when it cannot be drawn
    }
    Result<Stage> stage = Stage::create(device_, shaders_.source(), std::move(scene), options_->samples);
    if (!stage) return stage.error();
    if (start.handed) take_over(*start.handed);
    model_.scene = nullptr;
    probe_.reset();
    probe_key_.clear();
    stage_.emplace(std::move(*stage));
    model_.scene = &stage_->scene();
    model_.scene_path = loading_path_;
    model_.loading_words = std::move(start.loading_words);
    drawn_tint_ = model_.scene->skin.albedo_tint_linear;
    mean_albedo_.reset();
    if (first && !start.handed) {
        if (start.technique) {
            model_.choices[0].choose(*start.technique);
            if (start.values) model_.choices[0].values() = *start.values;
            model_.choices[1].choose(compared_with(*start.technique, model_.catalog.techniques));
        }
        model_.view = start.view;
        if (!options_->truth.empty()) open_truth(options_->truth);
    }
    if (!first) take_technique(file_look);
    file_look_ = file_look;
    const bool same_tone = model_.scene->skin.profile == tone_profile(model_.tone);
    if (!same_tone || (!reloading_ && !start.handed)) model_.tone = 0;
    if (reloading_ && model_.tone > 0) choose_tone(model_.tone);  // maps may have another mean
    follow_scene();
    return {};
}

// A device was lost: what was seen goes on.
void Session::take_over(const Handed& handed) {
    model_ = handed.model;
    model_.notices = {};
    if (!model_.vsync) swapchain_.reset();  // it was made to wait
    truth_image_ = handed.truth;
    truth_view_ = handed.truth_view;
}

// What the scene's file asks for; of one that is only read again, what it asks for anew.
void Session::take_technique(const Scene& look) {
    const bool asks_anew =
        !reloading_ || look.technique != file_look_.technique || look.settings != file_look_.settings;
    if (look.technique.empty() || !asks_anew) return;
    const Result<const Technique*> technique = find_technique(model_.catalog.techniques, look.technique);
    if (!technique) return model_.notices.complain("technique", technique.error().message);
    model_.choices[0].choose(**technique);
    model_.notices.clear("technique");
    for (const auto& [name, text] : look.settings)
        if (const Result<void> set = model_.choices[0].values().set(name, text); !set)
            model_.notices.complain("technique", set.error().message);
}

// Of a scene that stands: watches its files, remembers it, says what its files lack.
void Session::follow_scene() {
    scene_files_.watch(files_of(*model_.scene));
    remember(state_, model_.scene_path);
    model_.recent = state_.recent;
    reloading_ = scene_file_changed_ = false;
    model_.notices.clear("open");
    for (const std::string& warning : model_.scene->warnings)
        model_.notices.inform("warning", warning, now_s());
    window_.set_title(model_.scene->name + " - Dermis");
}

// A panorama is read again alone; anything else is the whole scene, beside the window's work.
bool Session::follow_scene_files() {
    const std::vector<fs::path> changed = scene_files_.changed();
    if (changed.empty()) return false;
    const Environment& around = model_.scene->environment;
    if (around.kind == EnvironmentKind::file && changed == std::vector{around.file}) {
        const Result<void> read = stage_->environment_changed();
        model_.notices.clear("surroundings");
        if (!read) model_.notices.complain("surroundings", read.error().message + kLastGood);
        return true;
    }
    load(model_.scene_path);
    reloading_ = true;
    scene_file_changed_ |= std::ranges::any_of(changed, [](const fs::path& file) { return is_scene(file); });
    return true;
}

bool Session::follow_files() {
    bool changed = false;
    if (now_s() - last_look_s_ >= kLookEveryS) {
        last_look_s_ = now_s();
        if (shaders_.poll() && stage_) {
            stage_->forget_shaders();
            shaders_unproven_ = changed = true;
        }
        if (stage_ && !loading_.valid()) changed |= follow_scene_files();
    }
    const std::vector<Notice> shown = model_.notices.all();
    for (const Notice& notice : shown)
        if (notice.topic.starts_with(kShaderTopic)) model_.notices.clear(notice.topic);
    for (const auto& [name, message] : shaders_.errors())
        model_.notices.complain(kShaderTopic + name, message + kLastGood);
    return changed;
}

}  // namespace dermis::view
