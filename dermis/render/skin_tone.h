#pragma once
// Skin of another tone on the same head.

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

/// The mean base colour of the scene's skin, linear: the maps are looked up at every vertex, so that what
/// lies outside of the islands does not count. 50 ms for a 2048 x 2048 JPEG. Errors: no skin, an unreadable
/// map.
[[nodiscard]] Result<Vec3> mean_skin_albedo(const Scene& scene);

/// Skin::albedo_tint_linear with which the mean becomes `albedo_linear`: relative differences (lips,
/// freckles) stay.
[[nodiscard]] Vec3 tint_towards(Vec3 albedo_linear, Vec3 mean_linear);

}  // namespace dermis::inline render
