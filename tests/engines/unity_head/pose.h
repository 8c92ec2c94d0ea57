#pragma once
// A GLB at a moment of a clip, as Unity's SkinnedMeshRenderer hands its vertices to a shader: blend shapes,
// then bones, which turn normals and tangents as they are.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engines/drawn_head/glb.h"

namespace dermis::unity_head {

using drawn_head::Glb;

struct Moment {
    std::string clip;  ///< empty: the nodes as the file opens
    double time_s = 0;
};

struct PosedNode {
    Eigen::Matrix4d to_world = Eigen::Matrix4d::Identity();
    std::vector<double> weights;  ///< of the mesh's targets
};

/// All nodes of the file. Errors: a clip that it does not have.
[[nodiscard]] Result<std::vector<PosedNode>> posed_nodes(const Glb& glb, const Moment& moment);

/// In the world, as glTF has it: three numbers of positions and normals, four of tangents.
struct Shape {
    std::vector<float> positions, normals, tangents;
};
[[nodiscard]] Shape posed_shape(const Glb& glb, const std::vector<PosedNode>& nodes, size_t node,
                                const nlohmann::json& primitive);

}  // namespace dermis::unity_head
