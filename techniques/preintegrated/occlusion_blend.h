#pragma once
// Scattered occlusion out of what vertices have: occlusion itself (variance 0) and three blurs of it. A
// Gaussian of the profile lies between two of the four and takes from both by its variance, which damps long
// waves, 1 - 2 pi^2 v / wavelength^2, as it does itself.

#include <array>

#include "dermis/optics/preintegration.h"

namespace dermis {

/// Weights a channel of the three blurs (kOcclusionVariance0Mm2 and following); what is missing to 1 is that
/// of the unblurred occlusion.
[[nodiscard]] std::array<Rgb, 3> occlusion_blend(const GaussianSum& profile);

}  // namespace dermis
