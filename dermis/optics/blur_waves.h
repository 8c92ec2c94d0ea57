#pragma once
// Where a blur is compared with a profile, and how much each place counts.

#include <array>

#include "dermis/optics/profile.h"

namespace dermis::inline optics {

inline constexpr int kBlurWaves = 24;
using WaveCurve = std::array<double, kBlurWaves>;

/// x of profile_transfer(), 1/mm^2, at even ratios: from waves that the widest Gaussian hardly damps to those
/// that the narrowest removes or that texels so large cannot hold. `profile` has terms; texel_mm > 0.
[[nodiscard]] WaveCurve blur_waves(const GaussianSum& profile, double texel_mm);

/// Errors of `kept`, the part of a wave that the profile leaves (0..1), count relative to the part that it
/// takes: 1 / (kTakenOffset + 1 - kept). Of long waves, which carry most of the light, little is taken.
inline constexpr double kTakenOffset = 0.1;
[[nodiscard]] constexpr double wave_importance(double kept) {
    return 1 / (kTakenOffset + 1 - kept);
}

}  // namespace dermis::inline optics
