#pragma once
// The one hash of a scene. Two scenes of one hash have the same light in every pixel: exposure, tone map,
// names and credits are not in it.

#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Objects with the bytes of their maps, lights, camera, environment with the bytes of its panorama,
/// background, profile and tint. Errors: a file that cannot be read.
[[nodiscard]] Result<std::string> hash_of(const Scene& scene);

/// The same without the objects and with the panorama's path instead of its bytes: some microseconds, for a
/// scene whose files have not changed since.
[[nodiscard]] std::string hash_of_views(const Scene& scene);

}  // namespace dermis::inline scene
