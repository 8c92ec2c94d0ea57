#pragma once
// The hash of a scene, and of the parts of it that a cached result depends on. Two scenes of one hash have
// the same light in every pixel: exposure, tone map, names and credits are not in it.

#include "dermis/base/hash.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Objects with the bytes of their maps, lights, camera, environment with the bytes of its panorama,
/// background, profile and tint. Errors: a file that cannot be read.
[[nodiscard]] Result<std::string> hash_of(const Scene& scene);

/// The same with the pose instead of the objects and with the panorama's path instead of its bytes: some
/// microseconds, for a scene whose files have not changed since.
[[nodiscard]] std::string hash_of_views(const Scene& scene);

/// Vertices, normals, triangles and the classes of their materials: what curvature, occlusion and flesh are
/// made of.
void add_shape(Hasher& hasher, const SceneObject& object);

/// Pixels, or the bytes of the file. Errors: a file that cannot be read.
[[nodiscard]] Result<void> add_image(Hasher& hasher, const ImageSource& source);

}  // namespace dermis::inline scene
