#pragma once
// Values at vertices, blurred over the surface or fitted to samples on it.

#include <array>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// Blurs `values`, one per vertex, by about a Gaussian of each of `variances_mm2` (0 or more) per axis along
/// the surface; one result each. Vertices at one position count as one, so UV seams do not show. Linear;
/// keeps constants and the sum weighted by area.
///
/// Heat on the surface (Desbrun et al. 1999, "Implicit Fairing of Irregular Meshes"): two implicit steps of
/// (A + t L) u' = A u with the areas A, the cotangent Laplacian L (negative weights counted as 0), and
/// t = variance / 4. The kernel has the Gaussian's variance, a sharper peak and longer tails.
[[nodiscard]] Result<std::vector<std::vector<float>>> blur_over_surface(
    const Mesh& mesh, std::span<const float> values, std::span<const double> variances_mm2);

/// Sums over the samples on one triangle, whose corners have the barycentric weights w0, w1, w2.
struct SurfaceSamples {
    std::array<float, 6> products = {};  ///< area * w0 w0, w1 w1, w2 w2, w1 w2, w2 w0, w0 w1, in mm^2
    std::array<Vec3, 3> values = {};     ///< area * value * w0, w1, w2
    /// As values, with the sign of the samples changed that were added with `negative`. With half of them
    /// negative the value itself cancels, and the noise of the samples stays.
    std::array<Vec3, 3> noise = {};

    void add(const std::array<float, 3>& weights, float area_mm2, Vec3 value, bool negative = false);
};

/// The function u, linear in each triangle, that minimises
/// sum(area * |u - value|^2) + variance_mm2 / 2 * integral(|grad u|^2):
/// a least-squares fit, blurred along the surface by a kernel of about this variance an axis. `samples`: one
/// entry a triangle. Parts of the surface without samples continue the rest; those without any near get 0.
[[nodiscard]] Result<std::vector<Vec3>> fit_over_surface(const Mesh& mesh,
                                                         std::span<const SurfaceSamples> samples,
                                                         double variance_mm2);

struct FitWithoutNoise {
    std::vector<Vec3> values;
    std::vector<Vec3> noise;  ///< one sample of the noise left in `values`; its square is their variance
};

/// Fits as fit_over_surface() does, but blurs strongly only where the samples show nothing but noise. The fit
/// of 1 mm^2 is split into bands by fits of four times the variance, up to 256 mm^2. Of a band b each place
/// keeps 1 - <n^2> / <b^2>, n the same band of the noise and <> the mean around the place: Wiener's filter
/// with the powers estimated (Ghael, Sayeed, Baraniuk 1997, "Improved Wavelet Denoising via Empirical Wiener
/// Filtering"). Cost: 10 fits and 8 blurs.
[[nodiscard]] Result<FitWithoutNoise> fit_without_noise(const Mesh& mesh,
                                                        std::span<const SurfaceSamples> samples);

}  // namespace dermis::inline mesh
