#pragma once
// Scattered occlusion from what the vertices hold: occlusion itself (variance 0) and three blurs of it. A
// Gaussian of the profile is replaced by a mix of the two with the nearest variances. The mix has the
// Gaussian's own variance v, so that it damps long waves by the same 1 - 2 pi^2 v / wavelength^2.

#include <array>

#include "dermis/optics/preintegration.h"

namespace dermis {

/// Weights of the three blurs (kOcclusionVariance0Mm2 and following) per channel; the rest to 1 is the weight
/// of the unblurred occlusion.
[[nodiscard]] std::array<Rgb, 3> occlusion_blend(const GaussianSum& profile);

}  // namespace dermis
