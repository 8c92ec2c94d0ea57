#pragma once
// Numbers as colours: black, violet, red, orange, pale yellow, of evenly rising lightness; and signed ones
// from blue over black to red.

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline judge {

/// 0 to 1 (clamped) to sRGB-encoded colour.
[[nodiscard]] Vec3 heat_color(float value);

/// A one-channel map as u8 sRGB: `full` and above is the brightest colour; outside the mask a neutral grey.
[[nodiscard]] Image heat_map(const Image& values, double full, const Image& mask);

/// -1 to 1 (clamped) to sRGB-encoded colour: blue below 0, red above, black at 0, lightness by the size.
[[nodiscard]] Vec3 signed_color(float value);

/// The mean of an RGB map's channels as u8 sRGB: `full` and above is the reddest colour, -full and below the
/// bluest; outside the mask a neutral grey.
[[nodiscard]] Image signed_map(const Image& rgb, double full, const Image& mask);

}  // namespace dermis::inline judge
