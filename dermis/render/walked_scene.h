#pragma once
// What is walked at the vertices of a scene whose materials may have several profiles.

#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/rays/vertex_links.h"
#include "dermis/scene/scene.h"
#include "dermis/technique/gain.h"

namespace dermis::inline render {

/// What the walks for `gain`, map or links, depend on beside shapes.
[[nodiscard]] std::string walks_key(const Scene& scene, Gain gain);

/// Gains (dermis/rays/vertex_gain.h), one array an object, each vertex by its material's profile. With
/// rest_bakes.gain they are of the rest pose. Errors: an unknown profile, or of vertex_gain.h.
[[nodiscard]] Result<std::vector<std::vector<Vec3>>> walk_scene_gains(const Scene& scene);

/// Links likewise.
[[nodiscard]] Result<VertexLinks> walk_scene_links(const Scene& scene);

}  // namespace dermis::inline render
