#pragma once
// RestBakes as text, as animation.rest_bakes has them.

#include <string>
#include <string_view>

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// "normals+gain", "all", or "none". Errors: an unknown word, with the known ones.
[[nodiscard]] Result<RestBakes> parse_rest_bakes(std::string_view text);

/// The inverse: "normals+gain", "all", "none".
[[nodiscard]] std::string rest_bakes_text(const RestBakes& bakes);

/// Whether Scene::rest_objects, if there are any, have the vertices and triangles of the objects.
[[nodiscard]] Result<void> check_rest_objects(const Scene& scene);

}  // namespace dermis::inline scene
