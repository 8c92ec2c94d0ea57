#pragma once
// Which baked quantities of a posed head are those of its rest pose, carried along by the vertices, as an
// engine has them that bakes once. Everything else is made again for the pose.

#include <string>
#include <string_view>

#include "dermis/base/result.h"

namespace dermis::inline scene {

struct RestBakes {
    bool normals = false;    ///< baked normals, which turn with the tangent frame of their texel
    bool curvature = false;  ///< curvature tensors of the vertices, which turn with their tangent frames
    bool gain = false;       ///< walked gains of the vertices, for gain=map
    bool occlusion = false;  ///< ambient occlusion of the vertices

    [[nodiscard]] bool any() const { return normals || curvature || gain || occlusion; }
    friend bool operator==(const RestBakes&, const RestBakes&) = default;
};

/// "normals+gain", "all", or "none". Errors: an unknown word, with the known ones.
[[nodiscard]] Result<RestBakes> parse_rest_bakes(std::string_view text);

/// The inverse: "normals+gain", "all", "none".
[[nodiscard]] std::string rest_bakes_text(const RestBakes& bakes);

}  // namespace dermis::inline scene
