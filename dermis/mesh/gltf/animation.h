#pragma once
// The animations of a glTF file. Internal to dermis/mesh.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/gltf/sampler.h"
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

/// What a clip sets: a property of a node.
struct Channel {
    uint64_t node = 0;
    std::string path;  ///< translation, rotation, scale, weights
    Keys keys;
};
/// Of a clip of the file; errors as of sample_clip(), and what is animated twice. Channels without a node are
/// left out.
[[nodiscard]] std::vector<Channel> read_channels(Document& document, const JsonView& clip);
/// Its name, or its number.
[[nodiscard]] std::string clip_name(const JsonView& clip, size_t index);

/// Names of a mesh's morph targets: `extras.targetNames`, else numbers.
[[nodiscard]] std::vector<std::string> target_names(const JsonView& mesh);

/// Replaces weights by the pose's, which are by name or number.
void choose_weights(const Pose& pose, const JsonView& mesh, std::vector<float>& weights);

/// All clips and targets. A clip that cannot be read is 0 s long and named in a warning.
[[nodiscard]] Motion read_motion(Document& document);

}  // namespace dermis::inline mesh::gltf
