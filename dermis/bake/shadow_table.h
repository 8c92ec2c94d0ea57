#pragma once
// Light that scatters into a shadow's penumbra (Penner 2011, GPU Pro 2, "Pre-Integrated Skin Shading", the
// shadow scattering part).
//
// A straight shadow edge on a flat surface. Across the edge the shadow filter rises from 0 to 1 over the
// width w mm, and p in 0..1 is the position in that ramp. The light itself is taken to rise inside the middle
// 1/k of the ramp only (k = sharpening): S(p) = smoothstep(1/2 + k (p - 1/2)), so that the rest of the
// filter's width remains to show light scattered out of it. The table is the light's edge blurred by the
// profile,
//
//     T(p, w) = int R_line(d) S(p + d / w) dd,
//
// with R_line the profile integrated along the edge: exactly a Gaussian of the same variance for each
// Gaussian. With k = 1 nothing is assumed, and what scatters further than the filter reaches is lost; 3 to 10
// are usual (FaceWorks calls the same ratio sharpening).
//
// In a shader: shadow = texture(table, vec2(p, w_mm mapped)).rgb in place of the filtered visibility, p from
// the filtered visibility s of a box filter is s itself.

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
