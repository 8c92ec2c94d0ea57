#pragma once
// Light that scatters into a shadow's penumbra (Penner 2011, GPU Pro 2, "Pre-Integrated Skin Shading").
//
// Across a straight edge on a flat surface the shadow filter rises from 0 to 1 over w mm; p in 0..1 is the
// position in that ramp. The light rises inside the middle 1/k of the ramp only (k = sharpening, 3 to 10 are
// usual): S(p) = smoothstep(1/2 + k (p - 1/2)). The rest of the ramp shows the scattered light:
//
//     T(p, w) = int R_line(d) S(p + d / w) dd,   R_line the profile integrated along the edge.
//
// In a shader: shadow = texture(table, vec2(p, w_mm mapped)).rgb in place of the filtered visibility; p is
// the visibility of a box filter.

#include "dermis/bake/table.h"
#include "dermis/optics/profile.h"

namespace dermis::inline bake {

/// Gaussians a channel that other profiles are fitted with.
inline constexpr int kShadowGaussians = 8;

struct ShadowOptions {
    Profile profile;
    int width = 256, height = 64;
    double min_width_mm = 1, max_width_mm = 40;
    AxisWarp width_warp = AxisWarp::linear;
    double sharpening = 3;
};

/// u = penumbra_position 0..1, v = penumbra_width_mm. Sums of Gaussians: closed form, within 1e-6. Other
/// profiles through their fit of 8 Gaussians a channel (optics/gaussian_fit.h), whose error they then have.
/// Errors: size, profile, widths outside 0.01..10000 mm, sharpening outside 1..1000.
[[nodiscard]] Result<Table> bake_shadow(const ShadowOptions& options);

/// T of one Gaussian of standard deviation sigma, everything in units of the ramp's width: about 1e-13.
[[nodiscard]] double blurred_smoothstep(double position, double sigma, double sharpening);

}  // namespace dermis::inline bake
