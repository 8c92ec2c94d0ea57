#pragma once
// The gain of a curved place: how much of uniform light it returns, over flat skin of the same medium.
// More paths leave a convex body before they are absorbed, fewer a concave one. Random walks in balls and
// ball-shaped cavities measure it; dermis/optics/gain_form.h has the closed form.

#include <span>
#include <vector>

#include "dermis/optics/gain_form.h"

namespace dermis::inline rays {

struct WalkedGains {
    Rgb flat;  ///< what the half-space returns, 0..1
    std::vector<GainSample> samples;
    std::vector<Rgb> standard_errors;  ///< of their gains
};

/// Curvatures to which forms are fitted: balls and cavities from 2 to 16 mm.
[[nodiscard]] std::span<const double> gain_curvatures();

/// Gains at these curvatures (not 0), each by `walks` walks with diffuse light from one point of a ball's or
/// a cavity's boundary, over what four times as many return in the half-space. Deterministic.
[[nodiscard]] WalkedGains walk_gain(const ScatteringMedium& medium, std::span<const double> curvatures_per_mm,
                                    int walks, uint32_t seed);

/// Fitted to walks at gain_curvatures(); cached. About 3 s of processor time.
[[nodiscard]] GainForm walked_gain_form(const ScatteringMedium& medium);

}  // namespace dermis::inline rays
