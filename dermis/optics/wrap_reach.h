#pragma once
// How far wrapped diffuse reaches past the terminator, from a profile.

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

/// The reach at mean curvature k is second_moment k^2 / (1 + bend k^2), times a scale that the shader has
/// (shaders/include/skin/wrap.glsl): red, green, blue. No reflectance in a channel: 0.
struct WrapReach {
    Rgb second_moment_mm2 = {0, 0, 0}, bend_mm2 = {0, 0, 0};
};

/// On a sphere of curvature k the profile damps the cosine's part of the light (its zonal harmonic of order
/// 1) by d(k) = sum w exp(-v k^2), and 1 - d is second_moment k^2 for small k. The bend is set so that 1 - d
/// is also right at 1/2 per mm.
[[nodiscard]] WrapReach wrap_reach(const GaussianSum& profile);

}  // namespace dermis::inline optics
