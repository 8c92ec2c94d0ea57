#pragma once
// A moment of the animations of a mesh file, and what a file has of them.

#include <map>
#include <span>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"

namespace dermis::inline mesh {

/// Where a mesh is in its motion. An empty pose is that of the file's nodes.
struct Pose {
    std::string clip;   ///< its name, or "#2" for the second; empty: none
    double time_s = 0;  ///< since the start of the clip; what lies outside holds the first or last pose
    bool loop = false;  ///< repeat the clip instead of holding its last pose
    /// Weights of morph targets by name, or by number ("#1"); they replace those of clip and file.
    std::map<std::string, float> morph;

    [[nodiscard]] bool empty() const { return clip.empty() && morph.empty(); }
    friend bool operator==(const Pose&, const Pose&) = default;
};

/// Weights of morph targets in a pose by their names in Motion.
using TargetWeights = std::map<std::string, float>;

/// All vertices of a mesh in a pose, counted as Mesh::file_vertices counts them.
struct PosedVertices {
    std::vector<Vec3> positions_mm, normals;
    TargetWeights target_weights = {};
};

/// A clip's weights of all targets as cubic splines, as glTF has them: at each time the slopes before it of
/// all targets, their weights, their slopes behind it.
struct WeightKeys {
    std::vector<float> times_s, values;
};

struct ClipInfo {
    std::string name;  ///< "#2" for the second if the file has no name for it
    double length_s = 0;
    size_t channels = 0;
    WeightKeys weights = {};  ///< of a clip that code makes
};

struct Motion {
    std::vector<ClipInfo> clips;
    std::vector<std::string> targets;  ///< morph targets of all meshes, each name once
    size_t skins = 0, joints = 0;

    [[nodiscard]] bool empty() const { return clips.empty() && targets.empty() && joints == 0; }
};

/// Whether one of the meshes has the clip, and one of them each target. The error names what there is.
[[nodiscard]] Result<void> check_pose(const Pose& pose, std::span<const Motion> motions);

/// "#3" for the third: the name of a clip or target that has none.
[[nodiscard]] std::string numbered_name(size_t index);

}  // namespace dermis::inline mesh
