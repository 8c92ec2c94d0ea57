#pragma once
// Adds what shading needs and files lack: the curvature of the skin at each vertex, the occlusion of the
// environment there, and an atlas for the skin.

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

/// Fills Mesh::curvatures_per_mm with its tensors, averaged over kCurvatureSmoothingMm, and Mesh::occlusions
/// of every object that lacks them, occluded by all opaque ones; cached by content, so that a second start
/// costs a file read. Then lay_out_skin_atlas().
[[nodiscard]] Result<void> complete_scene(Scene& scene);

/// One per vertex: its tensor, averaged over kCurvatureSmoothingMm. Cached by content.
[[nodiscard]] Result<std::vector<CurvatureTensor>> cached_curvature(const SceneObject& object);

/// One per vertex: its occlusion blurred over the surface by three variances (kOcclusionVariance0Mm2 and
/// following); 1 where the mesh has none. Cached by content. Errors as blur_over_surface().
[[nodiscard]] Result<std::vector<Vec3>> blurred_occlusions(const Mesh& mesh);

}  // namespace dermis::inline render
