#pragma once
// Diffusion profiles: how much of the light that enters a flat surface at one point leaves it at distance r.
//
// Four models behind one value type: sums of Gaussians, Burley's normalised diffusion, the dipole, and
// tables. r is in mm, R(r) in 1/mm^2, channels are linear Rec. 709 red, green, blue. The integral of R over
// the plane is the channel's diffuse albedo A; A = 1 is a pure blur kernel, whose colour lies in an albedo
// map.
//
//     Result<Profile> skin = find_profile("jensen_skin1");   // presets.h
//     double r_mm = mean_radius_mm(*skin, kRed);
//     GaussianSum fit = to_gaussian_sum(*skin).sum;           // gaussian_fit.h
//
// Everything here is pure and safe from any thread. Profiles made by check()ed input only; the functions
// assert it.

#include <array>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/optics/medium.h"
#include "dermis/optics/tabulated_profile.h"

namespace dermis::inline optics {

inline constexpr int kRed = 0, kGreen = 1, kBlue = 2;

/// One Gaussian; weights are linear red, green, blue and may be zero.
struct GaussianTerm {
    double variance_mm2 = 1;
    Rgb weight = {1, 1, 1};
};

/// R(r) = sum_i weight_i exp(-r^2 / (2 variance_i)) / (2 pi variance_i). The weights of a channel sum to its
/// diffuse albedo. Source: d'Eon, Luebke 2007, GPU Gems 3, chapter 14.
struct GaussianSum {
    std::string name;
    std::vector<GaussianTerm> terms;
};

/// The sum of the weights of each channel: its diffuse albedo.
[[nodiscard]] Rgb total_weight(std::span<const GaussianTerm> terms);

/// The share of a wave of light that the profile leaves, 1 for a colour that the skin does not reflect: the
/// sum of the weights times exp(-variance x), x = 2 pi^2 / wavelength^2 in 1/mm^2, over the sum of the
/// weights.
[[nodiscard]] Vec3 profile_transfer(const GaussianSum& profile, double x);

/// GPU Gems 3, section 14.4: six Gaussians fitted to a three-layer skin; weights
/// of each channel sum to 1.
[[nodiscard]] GaussianSum gpu_gems_3_skin();

/// R(r) = A (exp(-r/d) + exp(-r/3d)) / (8 pi d r), infinite at r = 0 but integrable. Source: Christensen,
/// Burley 2015, Approximate Reflectance Profiles for Efficient Subsurface Scattering, equation 3.
struct BurleyProfile {
    Rgb albedo = {1, 1, 1};  ///< 0..1
    Rgb d_mm = {1, 1, 1};    ///< > 0
    /// Mean cosine of the phase function of the volume that the profile describes, -0.99..0.99. Does not
    /// change R; walks and conversions between volumes keep it.
    double g = 0;
};

/// The dipole of Jensen, Marschner, Levoy, Hanrahan 2001, A Practical Model for Subsurface Light Transport,
/// equation 4 (its R_d), for the medium's reduced coefficients and relative index of refraction.
struct DipoleProfile {
    ScatteringMedium medium;
};

struct Profile {
    std::string name;
    std::string source;  ///< one line: author, year, place; or the file it came from
    std::variant<GaussianSum, BurleyProfile, DipoleProfile, TabulatedProfile> model;
};

/// "a sum of Gaussians", "Burley", "dipole", "table".
[[nodiscard]] std::string model_name(const Profile& profile);

/// Success when every function below has an answer. Errors name the value and its range: no terms, a variance
/// or length that is not positive and finite, a negative or NaN weight, an albedo outside 0..1, no
/// reflectance at all.
[[nodiscard]] Result<void> check(const Profile& profile);

/// R(r) in 1/mm^2, r_mm >= 0. Burley's is infinite at 0. Exact but for rounding.
[[nodiscard]] double reflectance_per_mm2(const Profile& profile, int channel, double r_mm);

/// The integral of R over the plane, 0..1 for physical profiles.
[[nodiscard]] double diffuse_albedo(const Profile& profile, int channel);

/// The part of the reflected light that leaves within r_mm, 0..1, closed form for every model. A channel
/// without any reflectance is a point: 1 everywhere.
[[nodiscard]] double cdf(const Profile& profile, int channel, double r_mm);

/// The radius within which the part u (clamped to 0..1) of the light leaves; infinite at u = 1 but for
/// tables. Closed form for Burley, else 80 or more evaluations of the CDF; |cdf(inverse) - u| < 1e-12.
[[nodiscard]] double inverse_cdf_mm(const Profile& profile, int channel, double u);

/// Mean and mean square of the distance at which light leaves. Burley: 2.5 d and 14 d^2. Closed forms.
[[nodiscard]] double mean_radius_mm(const Profile& profile, int channel);
[[nodiscard]] double mean_square_radius_mm2(const Profile& profile, int channel);

/// The part of the light that passes a slab of the same material, 1 at thickness 0: the profile at the
/// straight distance sqrt(r^2 + t^2) integrated over the far plane and divided by the albedo, which is 1 -
/// cdf(t). For a Gaussian exp(-t^2 / 2v); for Burley (exp(-t/d) + 3 exp(-t/3d)) / 4. Source: d'Eon, Luebke
/// 2007, section 14.5. It ignores the far boundary.
[[nodiscard]] double slab_transmittance(const Profile& profile, int channel, double thickness_mm);

/// The Burley profile of the same albedo, mean radius (d = mean / 2.5) and g. The common currency of
/// conversions.
[[nodiscard]] BurleyProfile burley_equivalent(const Profile& profile);

/// Of the model and its numbers, not of names: for keys of the cache.
[[nodiscard]] std::string hash_of(const Profile& profile);

/// All lengths times `factor` (> 0): R(r) becomes R(r / factor) / factor^2.
[[nodiscard]] Profile scaled(const Profile& profile, double factor);

}  // namespace dermis::inline optics
