// Values of a frame that are computed once for all pixels.

#include "dermis/render/frame_values.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dermis {
namespace {

// The real spherical harmonics' sum in the environment's own axes, term by term (Ramamoorthi and Hanrahan
// 2001, equation 3).
Vec3 radiance_in_environment(const std::array<Vec3, 9>& sh, Vec3 n) {
    return sh[0] * 0.282095f + (sh[1] * n.y + sh[2] * n.z + sh[3] * n.x) * 0.488603f +
           (sh[4] * (n.x * n.y) + sh[5] * (n.y * n.z) + sh[7] * (n.x * n.z)) * 1.092548f +
           sh[6] * (0.315392f * (3 * n.z * n.z - 1)) + sh[8] * (0.546274f * (n.x * n.x - n.y * n.y));
}

}  // namespace

TEST(FrameValues, the_terms_of_a_turned_environment_are_its_radiance_in_the_turned_direction) {
    std::array<Vec3, 9> sh;
    for (size_t i = 0; i < sh.size(); ++i) sh[i] = {1 + float(i), float(i * i % 7) - 3, 2.5f - float(i)};
    for (const float yaw_rad : {0.0f, 0.4f, 2.0f, -1.3f}) {
        const std::array<Vec3, 9> t = environment_terms(sh, yaw_rad);
        const float c = std::cos(yaw_rad), s = std::sin(yaw_rad);
        for (const Vec3 d :
             {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 2, -3}, Vec3{-2, 1, 0.5f}}) {
            const Vec3 n = normalize(d);
            const Vec3 sum = t[0] + t[1] * n.y + t[2] * n.z + t[3] * n.x + t[4] * (n.x * n.y) +
                             t[5] * (n.y * n.z) + t[6] * (3 * n.z * n.z - 1) + t[7] * (n.x * n.z) +
                             t[8] * (n.x * n.x - n.y * n.y);
            const Vec3 turned = {c * n.x - s * n.z, n.y, s * n.x + c * n.z};
            EXPECT_LT(length(sum - radiance_in_environment(sh, turned)), 2e-5f) << yaw_rad;
        }
    }
}

}  // namespace dermis
