#pragma once
// The hand-made curves of Simon Yeung 2015 ("Pre-Integrated Skin Shading", his blog) for pre-integrated skin,
// kept as published so that they can be measured: fitted by eye to a ring table of the GPU Gems 3 skin for
// radii of 2 to 16 mm, no profile enters. The minus signs are missing in the copy that was used; they are
// restored from what the text says of each curve (a line through 1 at N.L = 1, a parabola past the
// terminator, equal to the table at large r).

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

/// Diffuse light at n_dot_l -1..1; radii outside 2 to 16 mm count as those. Error against the sphere's
/// integral, largest channel: 0.20 at 2 mm, 0.071 at 4, 0.019 at 8, 0.017 at 16 (`dermis bake closed_form`).
[[nodiscard]] Rgb curve_2015_direct(double n_dot_l, double curvature_per_mm);

/// The pieces of the curve for 2 mm: a parabola (a cubic in blue) for the dark, a line for the light.
struct TightPieces {
    double dark = 0, light = 0;
};
[[nodiscard]] TightPieces curve_2015_tight_pieces(size_t channel, double n_dot_l);

/// Zonal harmonics of order 0, 1, 2; order 2 is Lambert's, as published.
[[nodiscard]] std::array<Rgb, 3> curve_2015_zonal(double curvature_per_mm);

}  // namespace dermis::inline optics
