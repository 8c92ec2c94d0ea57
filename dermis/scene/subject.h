#pragma once
// A subject is something to draw that is made by code. A scene names it
// "builtin:NAME", and sets its parameters beside it.
//
// A folder subjects/<name>/ defines `dermis::Subject dermis::make_<name>_subject();` and is found by CMake.

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/parameter.h"
#include "dermis/optics/profile.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// A point of skin under the key light alone, whose irradiance on a surface that faces it is 1.
struct ExactPoint {
    float irradiance = 0;  ///< shadow included
    Vec3 exitance;         ///< radiant exitance over albedo, red, green, blue
};

/// The exact result of the diffuse transport (the surface integral of the profile) at a point of the surface.
/// `penumbra_mm` is the width of a shadow's edge.
using ExactExitance =
    std::function<ExactPoint(const GaussianSum& profile, float penumbra_mm, Vec3 p_world_mm)>;

/// The result of a subject. Most make objects alone and are shown like a mesh file: framed from the front, in
/// the studio. A subject that is a test scene states its camera, lights and environment too, so that a
/// picture of it can be compared with a formula. A scene file overrides all three.
struct SubjectScene {
    std::vector<SceneObject> objects;
    std::optional<Camera> camera;
    /// One is the key light. Given: they replace the studio's light and its exposure; an environment is then
    /// stated too, kind none for no light but these.
    std::vector<Light> lights;
    std::optional<Environment> environment;
    /// The known answer of a test scene under its own lights; empty: unknown.
    ExactExitance exact;

    [[nodiscard]] bool states_anything() const { return camera || !lights.empty() || environment; }
};

struct Subject {
    std::string name;
    std::string summary;  ///< one line
    ParameterTable parameters;
    /// The same values give the same bytes. Errors: what the table's ranges do not exclude.
    std::function<Result<SubjectScene>(const ParameterValues&)> make;
    /// For a set of test scenes, the parameter whose choices are the scenes; else empty.
    std::string cases;
};

/// NAME of "builtin:NAME"; nothing for a path.
[[nodiscard]] std::optional<std::string_view> subject_name(std::string_view path_or_name);

/// Error: an unknown name, with the nearest and all known ones.
[[nodiscard]] Result<const Subject*> find_subject(std::span<const Subject> subjects, std::string_view name);

/// `parameters` as ParameterValues::set() takes them. Errors: an unknown name or parameter, a value out of
/// its range, what the subject says.
[[nodiscard]] Result<SubjectScene> make_subject(std::span<const Subject> subjects, std::string_view name,
                                                const std::map<std::string, std::string>& parameters = {});

/// The result as a scene: framed from the front, in the studio, unless it states otherwise.
[[nodiscard]] Scene scene_of(std::string name, SubjectScene made);

/// One scene of a set of test scenes.
struct SubjectCase {
    std::string name;  ///< "unit/sphere"
    Scene scene;
    ExactExitance exact;
};
/// All of a subject whose `cases` is not empty, in the order of its choices.
[[nodiscard]] Result<std::vector<SubjectCase>> make_cases(const Subject& subject);

/// Camera, lights and environment of `made` where it states them; the rest of the scene stays. The camera's
/// depth range is fitted to the scene's bounds.
void apply_statements(const SubjectScene& made, Scene& scene);

}  // namespace dermis::inline scene
