#include "dermis/engines/web/binary.h"

#include <algorithm>
#include <cmath>

namespace dermis::inline engines::web {

// EXT_texture_shared_exponent, section "Encoding of shared-exponent": bias 15, mantissas without a leading 1.
uint32_t shared_exponent(Vec3 color_linear) {
    constexpr int kBias = 15, kMantissaBits = 9;
    constexpr float kMax = 65408;
    const float r = std::clamp(color_linear.x, 0.0f, kMax), g = std::clamp(color_linear.y, 0.0f, kMax),
                b = std::clamp(color_linear.z, 0.0f, kMax);
    const float largest = std::max({r, g, b, std::ldexp(1.0f, -kBias)});
    int exponent = std::max(-kBias - 1, int(std::floor(std::log2(largest)))) + 1 + kBias;
    const auto mantissa = [&](float value) {
        return uint32_t(std::floor(std::ldexp(value, kBias + kMantissaBits - exponent) + 0.5f));
    };
    if (mantissa(largest) == 1u << kMantissaBits) ++exponent;
    return mantissa(r) | mantissa(g) << 9 | mantissa(b) << 18 | uint32_t(exponent) << 27;
}

}  // namespace dermis::inline engines::web
