#pragma once
// Low-discrepancy points and the GGX lobe they are mapped to.

#include <cmath>
#include <cstdint>
#include <numbers>

#include "dermis/base/vec.h"

namespace dermis::inline scene {

/// Point i of n in the unit square: (i / n, bits of i mirrored at the binary point).
[[nodiscard]] inline Vec2 hammersley(uint32_t i, uint32_t n) {
    uint32_t bits = i;
    bits = bits << 16 | bits >> 16;
    bits = (bits & 0x00ff00ffu) << 8 | (bits & 0xff00ff00u) >> 8;
    bits = (bits & 0x0f0f0f0fu) << 4 | (bits & 0xf0f0f0f0u) >> 4;
    bits = (bits & 0x33333333u) << 2 | (bits & 0xccccccccu) >> 2;
    bits = (bits & 0x55555555u) << 1 | (bits & 0xaaaaaaaau) >> 1;
    return {(float(i) + 0.5f) / float(n), float(bits) * 0x1p-32f};
}

/// Half vector around +Z with density D(h) n.h (Walter et al. 2007, equations 35 and 36).
[[nodiscard]] inline Vec3 sample_ggx_half_vector(Vec2 xi, float alpha) {
    const float cos2 = (1 - xi.x) / (1 + (alpha * alpha - 1) * xi.x);
    const float cos_theta = std::sqrt(cos2), sin_theta = std::sqrt(1 - cos2);
    const float phi = 2 * std::numbers::pi_v<float> * xi.y;
    return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

}  // namespace dermis::inline scene
