#pragma once
// The curvature of the sphere on which a mean normal has a given length, as a polynomial, for shaders without
// the table of it.

#include <array>

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

inline constexpr size_t kMeanCurvatureTerms = 6;

/// curvature = u (p_0 + p_1 u + ... + p_5 u^5) per mm, u = sqrt(1 - length), up to `largest_u`, which belongs
/// to 1 per mm.
struct MeanCurvature {
    std::array<double, kMeanCurvatureTerms> terms = {};
    double largest_u = 1;
    double max_error = 0;  ///< of the curvature, over the larger of it and 0.05 per mm
};

/// Of a channel: its mean cosine falls as curvature rises. Curvatures 0 to 1 per mm.
[[nodiscard]] MeanCurvature fit_mean_curvature(const GaussianSum& profile, size_t channel);

[[nodiscard]] double evaluate(const MeanCurvature& form, double mean_length);

}  // namespace dermis::inline optics
