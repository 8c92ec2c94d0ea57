#include "dermis/mesh/gltf/transform.h"

#include <cmath>

namespace dermis::inline mesh::gltf {
namespace {

std::array<double, 9> cofactors(const std::array<double, 9>& m) {
    return {m[4] * m[8] - m[5] * m[7], m[5] * m[6] - m[3] * m[8], m[3] * m[7] - m[4] * m[6],
            m[2] * m[7] - m[1] * m[8], m[0] * m[8] - m[2] * m[6], m[1] * m[6] - m[0] * m[7],
            m[1] * m[5] - m[2] * m[4], m[2] * m[3] - m[0] * m[5], m[0] * m[4] - m[1] * m[3]};
}

}  // namespace

double Affine::determinant() const {
    const auto c = cofactors(linear);
    return linear[0] * c[0] + linear[1] * c[1] + linear[2] * c[2];
}

Affine Affine::for_normals() const {
    Affine normals{.linear = cofactors(linear), .offset = {}};
    // Scaled so that the result stays within a float's range; the sign undoes a mirroring's.
    double largest = 0;
    for (const double c : normals.linear) largest = std::max(largest, std::abs(c));
    if (largest == 0) return Affine{};  // flattened to a line or a point: any normal will do
    const double scale = std::copysign(1 / largest, determinant());
    for (double& c : normals.linear) c *= scale;
    return normals;
}

Affine compose(const Affine& outer, const Affine& inner) {
    Affine both{.linear = {}, .offset = outer.offset};
    for (size_t r = 0; r < 3; ++r)
        for (size_t k = 0; k < 3; ++k) {
            for (size_t c = 0; c < 3; ++c)
                both.linear[3 * r + c] += outer.linear[3 * r + k] * inner.linear[3 * k + c];
            both.offset[r] += outer.linear[3 * r + k] * inner.offset[k];
        }
    return both;
}

Affine affine_of_matrix(const std::array<double, 16>& m) {
    return {.linear = {m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]},
            .offset = {m[12], m[13], m[14]}};
}

Affine affine_of_trs(const std::array<double, 3>& translation, std::array<double, 4> q,
                     const std::array<double, 3>& scale) {
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (norm > 0)
        for (double& part : q) part /= norm;
    else
        q = {0, 0, 0, 1};
    const auto [x, y, z, w] = q;
    const std::array<double, 9> rotation = {
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
        2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
        2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    Affine affine{.linear = rotation, .offset = translation};
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c) affine.linear[3 * r + c] *= scale[c];
    return affine;
}

}  // namespace dermis::inline mesh::gltf
