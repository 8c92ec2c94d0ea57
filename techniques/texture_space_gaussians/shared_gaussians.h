#pragma once
// A few Gaussians that all colours share, from a profile of any number of terms, for a light map whose texels
// hold no shorter waves than two of their sides.
//
// The profile leaves T_c(x) of a wave of colour c, the sum of w_c exp(-v x), x = 2 pi^2 f^2
// (profile_transfer()). Here a share of each colour stays as it is and the others are damped by `count`
// variances:
//     T_c(x) = 1 - sum_k s_ck (1 - exp(-v_k x)),   s_ck >= 0,   sum_k s_ck <= 1.
// Shares are least squares over x, evenly in log x up to the shortest wave, of errors over 0.1 + what the
// profile takes (1 - T): long waves, of which it takes little, are most of what a sphere shows (with plain
// errors spheres have .89 of the effect, with 0.1 .93, with 0.03 .94; the bust .816, .805, .800). Variances
// start from the best geometric series of a grid and are moved one by one.

#include "dermis/optics/profile.h"

namespace dermis::texture_space_gaussians {

inline constexpr int kMostSharedGaussians = 4;
inline constexpr double kSharedGaussiansError = 0.033;  ///< of T_c(x), times wave_importance()

/// As few as leave no wave and no colour off by more than kSharedGaussiansError, at most
/// kMostSharedGaussians. Narrowest first; the first has variance 0: what stays as it is. One that would have
/// less than a hundredth of every colour is left out. Weights of each colour sum to 1. A profile without
/// width has no terms. Largest error of T: gpu_gems_3 on texels of 0.8 mm .019 with 2, on 0.2 mm .011 with 4;
/// openpbr_skin_3 on 0.8 mm .013 with 3. Cost: 0.5 to 2 ms.
[[nodiscard]] GaussianSum shared_gaussians(const GaussianSum& profile, double texel_mm);

}  // namespace dermis::texture_space_gaussians
