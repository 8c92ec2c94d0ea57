#pragma once
// Constants of angles in single precision. Numerics in double use std::numbers.

#include <numbers>

namespace dermis::inline base {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kRadiansPerDegree = kPi / 180;
inline constexpr float kDegreesPerRadian = 180 / kPi;

}  // namespace dermis::inline base
