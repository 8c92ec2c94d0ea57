#pragma once
// The profile as a sum of few products a(x) a(y), which a blur along x and then along y can apply.
//
// A Gaussian of two dimensions is such a product, so a sum of n Gaussians, R = sum_i w_i g(v_i, x) g(v_i, y),
// is one of rank n. The nearest sum of fewer products, in the mean square over the plane, has the
// eigenfunctions of R as an operator (Schmidt 1907): with M_ij = sqrt(w_i w_j) <g(v_i), g(v_j)> and its
// eigenvectors u_k, the functions a_k = sum_i u_ik sqrt(w_i) g(v_i), whose products add up to R when all are
// taken. As M has no negative eigenvalue, both factors of a product are the same function.
//
// Nearest for what a picture can show: the mean square is that of both kernels blurred by kSeenMm, without
// which the peak, narrower than any pixel, would count more than all light around it.
// Source: Jimenez et al. 2015, Separable Subsurface Scattering, section 4 (singular value decomposition).

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

inline constexpr double kSeenMm = 0.2;

/// One product: a(x) = sum of amplitude[i] g(v_i, x), v_i and order those of the profile's terms.
struct SeparableTerm {
    std::vector<Rgb> amplitude;
};

struct SeparableTerms {
    /// The largest first. The light of all together is 1 in each channel. At most as many as asked for; a
    /// channel with fewer Gaussians has amplitudes of 0 in the rest.
    std::vector<SeparableTerm> terms;
    /// Root of the mean square of what is left out, over that of the profile, both as seen.
    Rgb error = {};
};

/// count is at least 1. A channel without reflectance keeps its light at the point.
[[nodiscard]] SeparableTerms separable_terms(const GaussianSum& profile, int count);

}  // namespace dermis::inline optics
