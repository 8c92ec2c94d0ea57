#include "dermis/view/opener.h"

#include <algorithm>
#include <iterator>

#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_words.h"
#include "dermis/scene/skin_tone.h"
#include "dermis/view/head_words.h"
#include "dermis/view/motion.h"
#include "dermis/view/scene_look.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

constexpr double kLookEveryS = 0.3;

const Technique* baseline_of(std::span<const Technique> all) {
    const auto baseline = std::ranges::find(all, true, &Technique::is_baseline);
    return baseline == all.end() ? nullptr : &*baseline;
}

// The baseline, or, for the baseline itself, the second technique.
const Technique& compared_with(const Technique& technique, std::span<const Technique> all) {
    const Technique* baseline = baseline_of(all);
    if (baseline && technique.id != baseline->id) return *baseline;
    return all[1 % all.size()];
}

}  // namespace

Opener::Opener(const ViewerOptions& options, std::future<Result<Start>> first, const OpenTargets& targets)
    : options_(options),
      to_(targets),
      loader_(std::move(first), options.scene_path, options.catalog.subjects) {}

void Opener::open(const std::string& path) {
    const std::string extension = to_lower(fs::path(path).extension().string());
    if (extension == ".hdr") return open_panorama(path);
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg")
        return to_.reference.open(path, to_.model);
    if (extension != ".exr") return load(path);
    // An EXR twice as wide as high is a panorama; any other is a rendered picture.
    const Result<LoadedImage> loaded = read_image(path, ImageUse::color);
    if (!loaded) return to_.model.notices.report_error("open", loaded.error().message);
    if (loaded->image.width == 2 * loaded->image.height) return open_panorama(path);
    to_.reference.open(path, to_.model);
}

void Opener::open_panorama(const std::string& path) {
    Model& model = to_.model;
    if (!model.scene) return;
    const Result<void> opened = to_.pictures.scene().open_panorama(path);
    if (!opened) return model.notices.report_error("open", opened.error().message);
    loader_.follow_too({path});
    model.notices.inform("open", "environment: " + path, to_.clock.now_s());
}

void Opener::load(const std::string& path, Load what) {
    Model& model = to_.model;
    const bool same = path == model.scene_path && model.scene;
    const Scene& file = to_.pictures.scene().file_look();
    if (!loader_.load(path, same ? words_to_load(model, file) : std::vector<SceneWord>(), what))
        model.notices.inform("open", "still loading " + loader_.path(), to_.clock.now_s());
}

void Opener::load_pose() {
    Model& model = to_.model;
    (void)loader_.load(model.scene_path, words_to_load(model, to_.pictures.scene().file_look()), Load::pose);
}

bool Opener::has_new_words() const {
    return to_.model.scene &&
           words_beside_motion(to_.model.loading_words) != words_beside_motion(shown_words_);
}

void Opener::follow_words() {
    if (!has_new_words() || loader_.is_loading()) return;
    load(to_.model.scene_path, Load::same_scene);
}

// What was changed while the scene was read stays for the next reading.
void Opener::take_words(std::vector<SceneWord> loaded) {
    std::vector<SceneWord>& words = to_.model.loading_words;
    shown_words_ = loaded;
    if (!loader_.is_reload()) {
        words = std::move(loaded);
        return;
    }
    words = words_beside_motion(std::move(words));
    std::ranges::copy_if(loaded, std::back_inserter(words),
                         [](const SceneWord& word) { return is_motion_key(word.key); });
}

Result<bool> Opener::take() {
    std::optional<Result<Start>> start = loader_.take();
    if (!start) return false;
    const Result<void> shown = *start ? take(std::move(**start)) : start->error();
    if (shown) return true;
    if (first_) return shown.error();
    if (loader_.is_reload()) to_.model.loading_words = shown_words_;
    if (loader_.is_reload()) loader_.follow_stated_files();  // a file may be missing and come later
    to_.model.notices.report_error("open", shown.error().message + (loader_.is_reload() ? kLastGood : ""));
    return false;
}

Result<void> Opener::take(Start start) {
    const Load what = loader_.what();
    ShownScene& shown = to_.pictures.scene();
    const bool same_look = what == Load::pose || what == Load::bakes;
    DERMIS_TRY(same_look ? shown.put_objects(std::move(start.scene)) : show(std::move(start)));
    if (shown.stage().lacks_bakes())
        loader_.complete(shown.stage().scene());
    else
        first_ = false;
    return {};
}

Result<void> Opener::show(Start start) {
    Model& model = to_.model;
    ShownScene& shown = to_.pictures.scene();
    const bool first = !shown.is_there();
    const Pose pose = start.handed ? start.handed->loaded_pose : start.scene.motion.pose();
    auto scene = std::make_unique<Scene>(std::move(start.scene));
    Scene file = start.file_look.value_or(without_objects(*scene));
    if (loader_.is_reload()) {
        if (loader_.file_changed())
            keep_look(shown.file_look(), *model.scene, *scene);
        else
            put_look(*model.scene, *scene);
        if (has_other_unit(*model.scene, *scene)) scale_look(*model.scene, *scene);
        loader_.follow_too(files_of(*scene));  // even if it cannot be drawn
    }
    DERMIS_TRY_ASSIGN(Stage stage,
                      Stage::create(to_.device, to_.pictures.shaders(), std::move(scene), options_.samples));
    if (first) take_start(start);
    const Technique* baseline = baseline_of(model.catalog.techniques);
    if (start.lacks_bakes && baseline) stage.await_bakes(*baseline);
    if (!first) take_technique(file);
    shown.put(std::move(stage), std::move(file), pose, model);
    model.scene_path = loader_.path();
    if (loader_.is_reload())
        model.warnings.begin_again();
    else
        model.warnings.forget();
    shown.stage().add_warnings(model.warnings);
    take_words(std::move(start.loading_words));
    const Skin& skin = model.scene->skin;
    const bool same_tone = skin.profile == tone_profile(model.tone);
    if (!loader_.is_reload() && !start.handed)
        model.tone = skin.albedo_tint_linear == skin.loaded_tint_linear ? skin.loaded_tone : 0;
    else if (!same_tone)
        model.tone = 0;
    if (loader_.is_reload() && model.tone > 0) shown.choose_tone(model.tone, model);  // another mean
    loader_.follow(*model.scene);
    model.notices.clear("open");
    return {};
}

// The first scene, or the state before a device was lost.
void Opener::take_start(const Start& start) {
    Model& model = to_.model;
    if (start.handed) {
        model = start.handed->model;
        model.notices = {};
        to_.reference.take_over(start.handed->reference, start.handed->reference_view);
        return;
    }
    if (start.technique) {
        model.choices[0].choose(*start.technique);
        if (start.values) model.choices[0].values() = *start.values;
        model.choices[1].choose(compared_with(*start.technique, model.catalog.techniques));
    }
    model.view = start.view;
    if (!options_.reference.empty()) to_.reference.open(options_.reference, model);
}

// Applies the file's technique and settings; after a reload only those that changed.
void Opener::take_technique(const Scene& file) {
    Model& model = to_.model;
    const Scene& before = to_.pictures.scene().file_look();
    const bool asks_anew =
        !loader_.is_reload() || file.technique != before.technique || file.settings != before.settings;
    if (file.technique.empty() || !asks_anew) return;
    const Result<const Technique*> technique = find_technique(model.catalog.techniques, file.technique);
    if (!technique) return model.notices.report_error("technique", technique.error().message);
    model.choices[0].choose(**technique);
    model.notices.clear("technique");
    if (const Result<void> set = model.choices[0].values().set_all(file.settings); !set)
        model.notices.report_error("technique", set.error().message);
}

bool Opener::follow_files() {
    bool changed = false;
    if (to_.clock.now_s() - last_look_s_ >= kLookEveryS) {
        last_look_s_ = to_.clock.now_s();
        changed = to_.pictures.follow_shaders();
        if (to_.pictures.scene().is_there() && !loader_.is_loading()) changed |= follow_scene_files();
    }
    to_.pictures.report_shaders(to_.model.notices);
    return changed;
}

// A changed panorama is read alone; after any other change the whole scene is loaded in the background.
bool Opener::follow_scene_files() {
    Model& model = to_.model;
    const std::vector<fs::path> changed = loader_.changed_files();
    if (changed.empty()) return false;
    const Environment& around = model.scene->environment;
    if (around.kind == EnvironmentKind::file && changed == std::vector{around.file}) {
        const Result<void> read = to_.pictures.scene().stage().environment_changed();
        model.notices.clear("environment");
        if (!read) model.notices.report_error("environment", read.error().message + kLastGood);
        return true;
    }
    load(model.scene_path, Load::same_scene);
    if (std::ranges::any_of(changed, is_scene_file)) loader_.note_changed_file();
    return true;
}

}  // namespace dermis::view
