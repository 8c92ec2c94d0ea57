#pragma once
// Affine node transforms in double: chains of scales of 0.01 and 100 must come out at 1. Internal to
// dermis/mesh.

#include <array>

#include "dermis/base/vec.h"

namespace dermis::inline mesh::gltf {

/// p_out = linear * p_in + offset; linear is row-major.
struct Affine {
    std::array<double, 9> linear = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    std::array<double, 3> offset = {0, 0, 0};

    [[nodiscard]] Vec3 point(Vec3 p) const {
        const Vec3 v = direction(p);
        return {float(v.x + offset[0]), float(v.y + offset[1]), float(v.z + offset[2])};
    }
    [[nodiscard]] Vec3 direction(Vec3 p) const {
        const auto& m = linear;
        return {float(m[0] * p.x + m[1] * p.y + m[2] * p.z), float(m[3] * p.x + m[4] * p.y + m[5] * p.z),
                float(m[6] * p.x + m[7] * p.y + m[8] * p.z)};
    }
    [[nodiscard]] double determinant() const;
    /// For normals: the inverse transpose up to a positive factor.
    [[nodiscard]] Affine for_normals() const;
};

/// First `inner`, then `outer`.
[[nodiscard]] Affine compose(const Affine& outer, const Affine& inner);

/// glTF's 16 column-major numbers; the last row is taken to be 0 0 0 1.
[[nodiscard]] Affine affine_of_matrix(const std::array<double, 16>& m);
[[nodiscard]] Affine affine_of_trs(const std::array<double, 3>& translation,
                                   std::array<double, 4> rotation_xyzw, const std::array<double, 3>& scale);

}  // namespace dermis::inline mesh::gltf
