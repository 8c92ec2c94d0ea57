#pragma once
// How much of each channel's diffuse light is of a smoother read of the normal map (Penner
// 2011, "one normal a channel"; d'Eon, Luebke 2007 and Hable 2010 before him by eye), from the profile and
// the map's scale.
//
// A read at a mip level averages a box of b mm, of variance b^2 / 12 along one axis. Light scattered by a sum
// of Gaussians sees the bumps through the kernel T = sum w_i G(v_i); the blend sees them through (1 - x)
// G(s0) + x G(s1), s0 and s1 the variances of the two reads. x makes the two nearest in the mean square for
// relief along a line whose power falls as the square of the frequency, as that of wrinkles and folds does:
//
//     x = <G(s0) - T(s0), G(s0) - G(s1)> / |G(s0) - G(s1)|^2,   <G(a), G(b)> = -(a + b)^(1/2)
//
// The inner product leaves out a constant that cancels in differences. For a white spectrum it would be
// (2 pi (a + b))^(-1/2): then the narrow channels lose relief that they keep (weights of green and blue twice
// as large).
//
// The smoother read is at most half as wide as a box with the widest channel's variance: a wider one averages
// what the table of curvature holds already, and over the map's seams. Captured share at 128 pixels for a
// half, three quarters and the whole of it: head scan .33, .20, .07; bust .18 each; backlit .40, .41, .41.

#include "dermis/optics/preintegration.h"

namespace dermis {

/// Weights of the smoother normal, 0..1 for each channel, and its mip levels above the sharp one.
struct NormalBlend {
    Rgb weight = {};
    double lod_bias = 0;
};

/// The widest smoother read.
[[nodiscard]] double widest_blend_mm(const GaussianSum& profile);

/// `sharp_mm` is what one texel of the sharp read covers on the skin, above 0; `max_lod_bias` at least 0.
[[nodiscard]] NormalBlend normal_blend(const GaussianSum& profile, double sharp_mm, double max_lod_bias);

}  // namespace dermis
