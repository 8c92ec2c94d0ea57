#pragma once
// How morph targets change the curvature of a head, for engines that move its vertices: a change for each
// target, which they add with the weights. Internal to dermis/engines.

#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/scene/scene.h"
#include "shaders/include/posing.h"

namespace dermis::inline engines {

/// The largest change of a vertex's mean curvature by all targets together, in 1/mm. The curvatures in all
/// directions change alike, by a tensor of the norm posing::kMostCurvatureChange.
inline constexpr float kMostMeanCurvatureChange = posing::kMostCurvatureChange / std::numbers::sqrt2_v<float>;

/// Changes are in steps of kMostMeanCurvatureChange / kCurvatureSteps, of at most so many.
inline constexpr int kCurvatureSteps = 127;

struct TargetCurvature {
    std::string name;             ///< of the morph target
    std::vector<int8_t> changes;  ///< of each vertex, for a weight that is larger by 1
};

/// Of those targets named that change any curvature, in their order: the mean curvature of the mesh with one
/// target at weight 1 (0 if the pose has more than half of it) against that in the pose, in which the object
/// is. Computes the curvature once a target. None without curvature, and where ScenePoser::can_pose() says
/// no. Errors: a file that cannot be read any more.
[[nodiscard]] Result<std::vector<TargetCurvature>> target_curvatures(const SceneObject& object,
                                                                     const Pose& pose,
                                                                     std::span<const std::string> names);

inline constexpr int kCurvaturePictureWidth = 2048;

/// Rows of the picture that one target takes.
[[nodiscard]] int curvature_rows(size_t vertex_count);

/// One channel of 8 bits: 128 plus the change. Vertex v of target t is at x = v % width, y = t * rows + v /
/// width. Targets are not empty and have the same vertices.
[[nodiscard]] Image curvature_picture(std::span<const TargetCurvature> targets);

}  // namespace dermis::inline engines
