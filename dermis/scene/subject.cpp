#include "dermis/scene/subject.h"

#include "dermis/base/text.h"

namespace dermis {

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
    const Result<const Subject*> subject = find_subject(subjects, name);
    if (!subject) return subject.error();
    ParameterValues values((*subject)->parameters);
    for (const auto& [parameter, text] : parameters)
        if (const Result<void> set = values.set(parameter, text); !set)
            return Error{(*subject)->name + ": " + set.error().message};
    return (*subject)->make(values);
}

void apply_statements(const SubjectScene& made, Scene& scene) {
    if (made.camera) {
        scene.camera = *made.camera;
        fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    }
    if (!made.lights.empty()) scene.lights = made.lights;
    if (made.environment) scene.environment = *made.environment;
}

}  // namespace dermis
