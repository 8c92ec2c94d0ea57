#include "dermis/base/text.h"
#include "dermis/scene/builtin.h"

namespace dermis {

Result<Scene> load_scene(const std::string& path_or_name) {
    constexpr std::string_view kBuiltin = "builtin:";
    const std::string name =
        path_or_name.starts_with(kBuiltin) ? path_or_name.substr(kBuiltin.size()) : path_or_name;
    Result<std::vector<SceneObject>> objects = make_builtin_objects(name);
    if (!objects) return objects.error();
    Scene scene{.name = name, .objects = std::move(*objects)};
    place_in_studio(scene);
    return scene;
}

}  // namespace dermis
