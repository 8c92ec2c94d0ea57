#pragma once
// Burley's d from the lengths that tools ask for: d = length / s(A), with s fitted by Christensen
// and Burley 2015 to Monte Carlo walks in an index-matched half-space, one fit per length and illumination. A
// is the albedo under diffuse light, 0..1; every s is positive.

namespace dermis::inline optics {

/// Mean free path / d for light that enters diffusely, right for blurring irradiance: equation 6.
[[nodiscard]] inline double mean_free_path_per_d(double albedo) {
    const double x = albedo - 0.8;
    return 1.9 - albedo + 3.5 * x * x;
}

/// Diffuse mean free path / d, searchlight: equation 8.
[[nodiscard]] inline double diffuse_mean_free_path_per_d(double albedo) {
    const double x = albedo - 0.33;
    return 3.5 + 100 * x * x * x * x;
}

}  // namespace dermis::inline optics
