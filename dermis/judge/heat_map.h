#pragma once
// Numbers as colours: black, violet, red, orange, pale yellow, of evenly rising lightness.

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis {

/// 0 to 1 (clamped) to sRGB-encoded colour.
[[nodiscard]] Vec3 heat_color(float value);

/// A one-channel map as u8 sRGB: `full` and above is the brightest colour; outside the mask a neutral grey.
[[nodiscard]] Image heat_map(const Image& values, double full, const Image& mask);

}  // namespace dermis
