#pragma once
// A scattering volume: coefficients per mm, and the lengths and albedos derived from them.
//
// Names of lengths, because tools call all of them "radius": mean free path l = 1 / sigma_t (MFP); reduced
// (transport) mean free path 1 / sigma_t'; diffuse mean free path l_d = 1 / sigma_tr (DMFP).

#include <array>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"

namespace dermis::inline optics {

/// sigma_s: scattering, sigma_a: absorption, per mm and channel (linear red, green, blue); g: mean cosine of
/// the (Henyey-Greenstein) phase function, -1..1; eta: index of refraction relative to the outside, 1..3.
struct ScatteringMedium {
    Rgb sigma_s_per_mm = {1, 1, 1};
    Rgb sigma_a_per_mm = {0.1, 0.1, 0.1};
    double g = 0;
    double eta = 1.4;
};

/// Errors name the value and its range.
[[nodiscard]] Result<void> check(const ScatteringMedium& medium);

[[nodiscard]] double sigma_t_per_mm(const ScatteringMedium& medium, int channel);
/// sigma_s' = sigma_s (1 - g); sigma_t' = sigma_s' + sigma_a.
[[nodiscard]] double reduced_sigma_s_per_mm(const ScatteringMedium& medium, int channel);
[[nodiscard]] double reduced_sigma_t_per_mm(const ScatteringMedium& medium, int channel);
/// sigma_s / sigma_t, 0..1.
[[nodiscard]] double single_scatter_albedo(const ScatteringMedium& medium, int channel);
/// sigma_s' / sigma_t', 0..1.
[[nodiscard]] double reduced_albedo(const ScatteringMedium& medium, int channel);
[[nodiscard]] double mean_free_path_mm(const ScatteringMedium& medium, int channel);
/// 1 / sqrt(3 sigma_a sigma_t'); infinite without absorption. Jensen 2001, section 2.1.
[[nodiscard]] double diffuse_mean_free_path_mm(const ScatteringMedium& medium, int channel);

/// Van de Hulst's similarity: the albedo C that multiple scattering in a half-space of single-scattering
/// albedo alpha shows under diffuse light, and its inverse, for an index-matched boundary. Both 0..1.
///   C = (1 - s)(1 - 0.139 s) / (1 + 1.17 s), s = sqrt((1 - alpha) / (1 - alpha g))
///   s = 4.09712 + 4.20863 C - sqrt(9.59217 + 41.6808 C + 17.7126 C^2), alpha = (1 - s^2) / (1 - g s^2)
/// Source: Kulla, Conty 2017, Revisiting Physically Based Shading at Imageworks; glTF and OpenPBR use it. The
/// inverse is a rounded closed form: forward(inverse(C)) = C within 1e-4 (tested).
[[nodiscard]] double multiscatter_albedo(double single_scatter_albedo, double g);
[[nodiscard]] double single_scatter_albedo_of(double multiscatter_albedo, double g);

/// The medium that shows `albedo` (0..1) at the mean free path 1 / sigma_t, per channel.
[[nodiscard]] ScatteringMedium medium_of(const Rgb& albedo, const Rgb& mean_free_path_mm, double g,
                                         double eta);

}  // namespace dermis::inline optics
