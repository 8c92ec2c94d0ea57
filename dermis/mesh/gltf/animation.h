#pragma once
// The animations of a glTF file. Internal to dermis/mesh.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/pose.h"

namespace dermis::inline mesh::gltf {

/// The parts of a node's transformation that a clip sets.
struct NodePose {
    std::optional<std::array<double, 3>> translation, scale;
    std::optional<std::array<double, 4>> rotation;  ///< x y z w
    std::vector<float> weights;                     ///< of morph targets; empty: the file's
};
using NodePoses = std::map<uint64_t, NodePose>;

/// The nodes at a moment of the pose's clip; empty if the file lacks the clip. Errors in messages: times that
/// are not finite or go back, as many values as keys need, nodes that do not exist or have a matrix,
/// KHR_animation_pointer.
[[nodiscard]] NodePoses sample_clip(Document& document, const Pose& pose);

/// Names of a mesh's morph targets: `extras.targetNames`, else numbers.
[[nodiscard]] std::vector<std::string> target_names(const JsonView& mesh);

/// All clips and targets. A clip that cannot be read is 0 s long and named in a warning.
[[nodiscard]] Motion read_motion(Document& document);

}  // namespace dermis::inline mesh::gltf
