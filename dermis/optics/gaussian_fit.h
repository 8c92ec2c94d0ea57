#pragma once
// A sum of Gaussians for any profile, so that every table, blur and shader has one form to work on.
//
// Fits S(r) = 1 - cdf(r), the part of the light that leaves beyond r, by sum_i w_i
// exp(-r^2/2v_i): bounded where R itself is infinite (Burley at 0), and the slab transmittance at the same
// time. Burley's and the dipole's S are completely monotone in r^2, so positive weights suffice and more
// terms always help. Each channel gets its own Gaussians, placed by Levenberg-Marquardt on log variances and
// weights, then reweighted to level the error (Lawson 1961). Weights are positive and sum to the albedo.

#include <array>

#include "dermis/optics/profile.h"

namespace dermis::inline optics {

inline constexpr int kMaxGaussianFitTerms = 12;

struct GaussianFit {
    GaussianSum sum;
    /// Largest and root-mean-square |S - S_fit| per channel, over 200 radii from the 0.1 % to the 99.99 %
    /// radius evenly in log r: the part of the light at a wrong distance. 0 for what is a sum of Gaussians
    /// already.
    Rgb max_error = {0, 0, 0};
    Rgb rms_error = {0, 0, 0};
};

/// 1 to kMaxGaussianFitTerms Gaussians per channel; a sum of Gaussians is returned unchanged. Takes tens of
/// milliseconds per channel. `dermis profile table` prints the errors.
[[nodiscard]] GaussianFit to_gaussian_sum(const Profile& profile, int terms_per_channel = 6);

}  // namespace dermis::inline optics
