#include "compare_scenes.h"

#include <algorithm>

#include "catalog/catalog.h"
#include "dermis/base/text.h"
#include "dermis/render/complete_scene.h"

namespace dermis::cli {
namespace {

// All scenes of the set, or the one that a word chooses; the other words change each scene.
Result<ComparedScenes> scenes_of_set(const Subject& subject, const SceneChoice& choice) {
    DERMIS_TRY_ASSIGN(const std::vector<SceneWord> words, choice.all_words());
    Result<std::vector<SubjectCase>> cases = make_cases(subject);
    if (!cases) return cases.error();
    for (const SceneWord& word : words_for(words, true)) {
        if (word.key != "mesh." + subject.cases)
            return Error{"--scene " + word.key + ": of the set of test scenes '" + subject.name +
                         "' only mesh." + subject.cases +
                         " and what does not change the meshes can be given"};
        const std::vector<std::string>& names = subject.parameters.find(subject.cases)->choices;
        if (std::ranges::find(names, word.value) == names.end())
            return Error{"--scene " + word.key + ": " + unknown_name("test scene", word.value, names)};
        std::erase_if(*cases,
                      [&](const SubjectCase& one) { return one.name != subject.name + "/" + word.value; });
    }
    for (SubjectCase& one : *cases) {
        const std::vector<SceneWord> changes = words_for(words, false);
        // The exact answer is valid under the scene's own light only.
        if (std::ranges::any_of(changes, [](const SceneWord& w) {
                return w.key.starts_with("light") || w.key.starts_with("environment");
            }))
            one.exact = {};
        DERMIS_TRY(change_scene(one.scene, changes));
        DERMIS_TRY(complete_scene(one.scene));
    }
    return ComparedScenes{std::move(*cases), true};
}

}  // namespace

const Subject* set_of_scenes(const std::string& name) {
    const auto found =
        std::ranges::find(built_in_catalog().subjects, subject_name(name).value_or(name), &Subject::name);
    return found == built_in_catalog().subjects.end() || found->cases.empty() ? nullptr : &*found;
}

Result<ComparedScenes> compared_scenes(const CompareChoice& choice) {
    if (const Subject* set = set_of_scenes(choice.scene.name)) return scenes_of_set(*set, choice.scene);
    DERMIS_TRY_ASSIGN(Scene scene, choice.load_scene());
    ComparedScenes scenes;
    scenes.all.push_back({.name = choice.scene.name, .scene = std::move(scene)});
    return scenes;
}

}  // namespace dermis::cli
