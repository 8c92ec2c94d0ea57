#pragma once
// A material's maps as JPEG. Internal to dermis/engines.

#include <nlohmann/json.hpp>

#include "dermis/engines/web.h"

namespace dermis::inline engines::web {

/// Adds the maps of `material` to `files` as "maps/N_albedo.jpg", "_normal.jpg" and "_surface.jpg"
/// (roughness, factor on the reflectance, occlusion). JSON: "maps" has the paths of those that there are,
/// "wraps" what one has beyond its edges along u and v, where it does not repeat. Error: maps of one picture
/// wrap differently.
[[nodiscard]] Result<nlohmann::json> add_maps(std::vector<WebFile>& files, const Material& material,
                                              const Mesh& mesh, const std::string& prefix, int map_side);

}  // namespace dermis::inline engines::web
