#pragma once
// The nodes of a glTF file in millimetres. Internal to dermis/mesh.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/gltf/animation.h"
#include "dermis/mesh/gltf/document.h"

namespace dermis::inline mesh::gltf {

/// p_out = linear * p_in + offset, in double: chains of scales of 0.01 and 100 must come out at 1.
struct Affine {
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();

    [[nodiscard]] Vec3 direction(Vec3 p) const {
        const Eigen::Vector3d v = linear * Eigen::Vector3d(p.x, p.y, p.z);
        return {float(v.x()), float(v.y()), float(v.z())};
    }
    [[nodiscard]] Vec3 point(Vec3 p) const {
        const Vec3 v = direction(p);
        return {float(v.x + offset.x()), float(v.y + offset.y()), float(v.z + offset.z())};
    }
    /// For normals: the inverse transpose up to a positive factor.
    [[nodiscard]] Affine for_normals() const;
};
/// First `inner`, then `outer`.
[[nodiscard]] inline Affine compose(const Affine& outer, const Affine& inner) {
    return {outer.linear * inner.linear, outer.offset + outer.linear * inner.offset};
}
/// glTF's 16 column-major numbers; the last row is taken to be 0 0 0 1.
[[nodiscard]] Affine affine_of_matrix(const std::array<double, 16>& m);
/// Scaled, turned by a quaternion x y z w of any length (0: not), moved.
[[nodiscard]] Affine affine_of(const std::array<double, 3>& translation,
                               const std::array<double, 4>& rotation, const std::array<double, 3>& scale);

struct NodeTree {
    std::vector<Affine> world;  ///< of every node, also of those outside of the default scene (joints may be)
    std::vector<uint64_t> drawn;  ///< nodes of the default scene with a mesh, in its order
};

/// `to_mm` comes after every root, `poses` replace what the file states of nodes. Errors (a node reached
/// twice, too many of them) are left in messages.
[[nodiscard]] NodeTree read_nodes(Document& document, const Affine& to_mm, const NodePoses& poses = {});

}  // namespace dermis::inline mesh::gltf
