#include "dermis/scene/subject.h"

#include "dermis/base/text.h"
#include "dermis/scene/placement.h"

namespace dermis::inline scene {

std::optional<std::string_view> subject_name(std::string_view path_or_name) {
    constexpr std::string_view kBuiltin = "builtin:";
    if (!path_or_name.starts_with(kBuiltin)) return std::nullopt;
    return path_or_name.substr(kBuiltin.size());
}

Result<const Subject*> find_subject(std::span<const Subject> subjects, std::string_view name) {
    std::vector<std::string> names;
    for (const Subject& subject : subjects) {
        if (subject.name == name) return &subject;
        names.push_back(subject.name);
    }
    return Error{unknown_name("built-in scene", name, names)};
}

Result<SubjectScene> make_subject(std::span<const Subject> subjects, std::string_view name,
                                  const std::map<std::string, std::string>& parameters) {
    DERMIS_TRY_ASSIGN(const Subject* subject, find_subject(subjects, name));
    ParameterValues values(subject->parameters);
    for (const auto& [parameter, text] : parameters)
        if (const Result<void> set = values.set(parameter, text); !set)
            return Error{subject->name + ": " + set.error().message};
    return subject->make(values);
}

Scene scene_of(std::string name, SubjectScene made) {
    Scene scene{.name = std::move(name), .objects = std::move(made.objects)};
    place_in_studio(scene);
    if (!made.lights.empty()) scene.exposure_ev = 0;
    apply_statements(made, scene);
    return scene;
}

Result<std::vector<SubjectCase>> make_cases(const Subject& subject) {
    std::vector<SubjectCase> cases;
    const Parameter* choice = subject.parameters.find(subject.cases);
    if (!choice) return Error{subject.name + ": is one scene, not a set of test scenes"};
    for (const std::string& value : choice->choices) {
        DERMIS_TRY_ASSIGN(SubjectScene made,
                          make_subject({&subject, 1}, subject.name, {{subject.cases, value}}));
        ExactExitance exact = made.exact;
        const std::string name = subject.name + "/" + value;
        cases.push_back({.name = name, .scene = scene_of(name, std::move(made)), .exact = std::move(exact)});
    }
    return cases;
}

void apply_statements(const SubjectScene& made, Scene& scene) {
    if (made.camera) {
        scene.camera = *made.camera;
        fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    }
    if (!made.lights.empty()) scene.lights = made.lights;
    if (made.environment) scene.environment = *made.environment;
}

}  // namespace dermis::inline scene
