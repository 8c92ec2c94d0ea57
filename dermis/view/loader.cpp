#include "dermis/view/loader.h"

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/scene_files.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

Result<Start> bake(Start start) {
    DERMIS_TRY(complete_scene(start.scene));
    start.lacks_bakes = false;
    return start;
}

Result<Start> load_start(const std::string& path, std::span<const Subject> subjects,
                         const std::vector<SceneWord>& words, Load what) {
    DERMIS_TRY_ASSIGN(Scene scene, load_scene(path, {.subjects = subjects, .words = words}));
    Start start = {.scene = std::move(scene), .lacks_bakes = true, .loading_words = words};
    if (what == Load::scene) return start;
    return bake(std::move(start));
}

}  // namespace

bool is_scene_file(const fs::path& file) {
    return to_lower(file.extension().string()) == ".toml";
}

bool Loader::load(const std::string& path, const std::vector<SceneWord>& words, Load what) {
    if (loading_.valid()) return false;
    path_ = path;
    what_ = what;
    loading_ = std::async(std::launch::async, load_start, path, subjects_, words, what);
    return true;
}

void Loader::complete(Scene scene) {
    what_ = Load::bakes;
    loading_ = std::async(std::launch::async, bake, Start{.scene = std::move(scene), .lacks_bakes = true});
}

std::optional<Result<Start>> Loader::take() {
    if (!loading_.valid() || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return {};
    return loading_.get();
}

void Loader::follow(const Scene& scene) {
    files_.watch(files_of(scene));
    file_changed_ = false;
}

std::vector<fs::path> Loader::stated_files() const {
    const fs::path file = is_scene_file(path_) ? fs::path(path_) : find_scene(path_);
    const Result<std::string> text = read_text_file(file);
    const Result<SceneDescription> description = text ? parse_scene(*text, file, subjects_) : text.error();
    return description ? paths_of(*description) : std::vector<fs::path>();
}

}  // namespace dermis::view
