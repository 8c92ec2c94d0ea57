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

}  // namespace dermis::inline scene
