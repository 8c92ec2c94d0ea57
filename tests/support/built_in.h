#pragma once
// What the program is built with, for tests that need some of it.

#include <string>
#include <string_view>

#include "catalog/catalog.h"
#include "dermis/scene/load_scene.h"

namespace dermis {

/// `id` is known.
[[nodiscard]] inline const Technique& built_in_technique(std::string_view id) {
    return **find_technique(built_in_catalog().techniques, id);
}

[[nodiscard]] inline Result<Scene> load_built_in_scene(const std::string& path_or_name) {
    return load_scene(path_or_name, {.subjects = built_in_catalog().subjects});
}

}  // namespace dermis
