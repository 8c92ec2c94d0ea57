#pragma once
// IEEE 754 binary16 ("half", f16) as bits: 1 sign, 5 exponent, 10 mantissa bits; largest finite value 65504,
// smallest positive 2^-24, relative rounding error at most 2^-11 above 2^-14.

#include <bit>
#include <cstdint>

namespace dermis::inline image {

inline constexpr float kMaxHalf = 65504.0f;

/// Exact.
constexpr float from_half(uint16_t half) {
    const uint32_t sign = uint32_t(half & 0x8000u) << 16;
    const uint32_t magnitude = half & 0x7fffu;
    if (magnitude >= 0x7c00u) return std::bit_cast<float>(sign | 0x7f800000u | (magnitude & 0x3ffu) << 13);
    // The bits shifted into a float's place have an exponent too small by 127 - 15; the product corrects it,
    // and it is exact for denormal halves too (they are normal floats).
    const float value = std::bit_cast<float>(magnitude << 13) * 0x1p112f;
    return std::bit_cast<float>(std::bit_cast<uint32_t>(value) | sign);
}

/// Rounds to nearest, ties to even. Finite values beyond the range saturate to +-65504 (a sun disc stays
/// finite and summable); infinities and NaN stay what they are.
constexpr uint16_t to_half(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint16_t sign = uint16_t(bits >> 16 & 0x8000u);
    const uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude > 0x7f800000u) return sign | 0x7e00u;
    if (magnitude == 0x7f800000u) return sign | 0x7c00u;
    if (magnitude >= std::bit_cast<uint32_t>(kMaxHalf)) return sign | 0x7bffu;
    if (magnitude < 0x38800000u) {
        // Below 2^-14 halves are multiples of 2^-24: adding 0.5 puts that unit at the float's last bit, so
        // the addition itself rounds to even.
        const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
        return sign | uint16_t(std::bit_cast<uint32_t>(shifted) - 0x3f000000u);
    }
    const uint32_t rebias = uint32_t(127 - 15) << 23;
    const uint32_t rounded = magnitude - rebias + 0xfffu + (magnitude >> 13 & 1u);
    return sign | uint16_t(rounded >> 13);
}

}  // namespace dermis::inline image
