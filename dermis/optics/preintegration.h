#pragma once
// Pre-integrated diffuse skin: what a Lambertian surface of constant curvature looks like after its
// irradiance was blurred by a diffusion profile, as a function of N.L and of the radius.
//
// A Gaussian of variance v, taken at the chord 2 r sin(x/2) between two points of a ring or sphere of radius
// r that are the angle x apart, is exp(-kappa (1 - cos x)) with kappa = r^2 / v: exactly a von Mises lobe on
// the ring, a von Mises-Fisher lobe on the sphere. So one universal function of two numbers, F(n_dot_l,
// kappa) = the clamped cosine max(0, n_dot_l) blurred by the lobe, serves every Gaussian sum at every radius:
//
//     D(n_dot_l, r) = sum_i w_i(r) F(n_dot_l, r^2 / v_i),   sum_i w_i = 1 in each channel.
//
// Units: radius and distance in mm, curvature in 1/mm, variance in mm^2. Axes: n_dot_l in [-1, 1], not
// clamped and not remapped; radius_mm in (0, infinity], infinity being a flat surface, where D is max(0,
// n_dot_l).
//
// Accuracy, tested against adaptive quadrature from 0.25 to 1000 mm: 1e-8 for the sum of Gaussians of GPU
// Gems 3, 1e-6 as floats for every preset; the two methods for lobes agree within 1e-10 where they meet.
// Cost: see DiffuseRows.
//
// Sources: Penner 2011 (GPU Pro 2, "Pre-Integrated Skin Shading") for the idea and the ring; Fisher 1953 and
// Mardia, Jupp 2000, Directional Statistics, section 9.3.2 for the lobes; docs/preintegration.md derives the
// rest.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis::inline optics {

/// The shape of the skin around the shaded point.
enum class Construction {
    sphere,     ///< closed sphere; conserves energy; the default everywhere
    full_ring,  ///< Penner's ring, integrated over the whole circle, as FaceWorks and Yeung 2015 do; too
                ///< bright when strongly curved
    half_ring   ///< the ring from -90 to +90 degrees, as the Unity script of 2011 integrates it
};

/// How a ring weighs Gaussians against one another: as lines (1 / sqrt(2 pi v), what published code does) or
/// as areas (1 / (2 pi v), what the profile means). The sphere is always by area.
enum class RingWeights { line, area };

struct Preintegration {
    Construction construction = Construction::sphere;
    RingWeights ring_weights = RingWeights::line;
    /// Every variance is multiplied by this first; 1 is right, 1.414 reproduces widely copied code.
    double variance_scale = 1;
};

/// The table of the Unity script of 2011.
inline constexpr Preintegration kUnity2011Ring = {.construction = Construction::half_ring,
                                                  .variance_scale = 1.414};
/// The table that Yeung 2015 fitted: of rings and factors this one is nearest to his curves past the
/// terminator (red, r = 2 mm, N.L from -1 to 0: rms .0055; the half ring with factor 1: .040).
inline constexpr Preintegration kYeung2015Ring = {.construction = Construction::full_ring,
                                                  .variance_scale = 1.414};

/// F(n_dot_l, kappa); concentration kappa >= 0, infinity allowed. About 1 microsecond.
[[nodiscard]] double blurred_cosine(Construction construction, double n_dot_l, double concentration);

/// Fails on: no Gaussians, a variance that is not positive and finite, a weight that is not finite, a channel
/// whose weights do not sum to more than 0. The message names the Gaussian and the value.
[[nodiscard]] Result<void> check_preintegrable(const GaussianSum& profile);

/// The weights w_i(r) of the header's formula, per Gaussian; each channel sums to 1. The profile has passed
/// check_preintegrable. NaN where negative weights of a fit outweigh the others on so small a radius.
[[nodiscard]] std::vector<Rgb> lobe_weights(const GaussianSum& profile, double radius_mm,
                                            const Preintegration& how = {});

/// D(n_dot_l, r) at one point. For many points of one radius use DiffuseRows.
[[nodiscard]] Rgb preintegrated_diffuse(const GaussianSum& profile, double n_dot_l, double radius_mm,
                                        const Preintegration& how = {});

/// The weighted mean cosine A(r) of the lobes: D(t, r) - D(-t, r) = A(r) t, without error.
[[nodiscard]] Rgb preintegrated_mean_cosine(const GaussianSum& profile, double radius_mm,
                                            const Preintegration& how = {});

/// D projected onto the zonal harmonics of order 0, 1, 2: zh_l = 2 pi K_l * integral of D(t) P_l(t) dt over
/// [-1, 1], K_l = sqrt((2l+1) / 4 pi). Order 0 of a sphere is sqrt(pi)/2 whatever the profile; closed form
/// for the sphere, 1e-9 or better for the rings.
[[nodiscard]] std::array<Rgb, 3> preintegrated_zonal_harmonics(const GaussianSum& profile, double radius_mm,
                                                               const Preintegration& how = {});

/// D at fixed values of n_dot_l for one radius after another. Construction computes the basis functions once;
/// a row of 512 values and three channels of six Gaussians then takes about 15 microseconds (values of
/// n_dot_l that mirror each other share their even part). Immutable: rows may be evaluated from several
/// threads.
class DiffuseRows {
  public:
    /// n_dot_l: any order, each in [-1, 1].
    explicit DiffuseRows(std::span<const double> n_dot_l, const Preintegration& how = {});

    [[nodiscard]] size_t size() const { return n_dot_l_.size(); }

    /// rgb: 3 * size() values, interleaved. The profile has passed check_preintegrable.
    void evaluate(const GaussianSum& profile, double radius_mm, std::span<double> rgb) const;
    void evaluate(const GaussianSum& profile, double radius_mm, std::span<float> rgb) const;

  private:
    template <class Number>
    void evaluate_into(const GaussianSum& profile, double radius_mm, std::span<Number> rgb) const;

    Preintegration how_;
    std::vector<double> n_dot_l_;
    std::vector<size_t> elevation_of_;          // index into the two below
    std::vector<double> sine_, chord_squared_;  // of each distinct elevation, ascending
    std::vector<double> basis_;                 // block by block of elevations
};

/// A profile that is not a Gaussian sum: R(distance_mm) per channel, any common scale; finite and smooth for
/// distances above 0, and distance * R finite towards 0 (a 1/r pole is allowed).
struct RadialProfile {
    std::function<Rgb(double distance_mm)> reflectance;
    /// The smallest length on which R changes, e.g. the smallest d of a Burley profile: where panels begin.
    double finest_mm = 0.01;
};

/// The same function of the sphere for a general profile, by quadrature over rings of the sphere; 1e-7 or
/// better for Burley and dipole profiles, about 20 microseconds a point.
[[nodiscard]] std::vector<Rgb> preintegrated_diffuse(const RadialProfile& profile,
                                                     std::span<const double> n_dot_l, double radius_mm);
[[nodiscard]] std::array<Rgb, 3> preintegrated_zonal_harmonics(const RadialProfile& profile,
                                                               double radius_mm);

}  // namespace dermis::inline optics
