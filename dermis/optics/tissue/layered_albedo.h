#pragma once
// The albedo of two layers by adding and doubling: a thin layer on a half-space, below a smooth boundary.
//
// Henyey and Greenstein scatter, in four Legendre polynomials after delta-M scaling. A thin slab is doubled
// to the layer, and until nothing passes to the half-space; Fresnel's reflection from inside closes the sum.
// Sources: Prahl, van Gemert, Welch 1993, Determining the optical properties of turbid media by using the
// adding-doubling method; Wiscombe 1977, The delta-M method.

#include <span>
#include <vector>

namespace dermis::inline optics::tissue {

/// Reduced scattering and absorption, > 0 and >= 0.
struct TissueLayer {
    double sigma_s_per_mm = 1, sigma_a_per_mm = 0;  // sigma_s: reduced
};

/// The share, 0..1, of diffuse light that entered and leaves again. eta: index of refraction of both layers
/// relative to the outside, 1..2. 30 microseconds. docs/skin_model.md has the error.
[[nodiscard]] double layered_albedo(const TissueLayer& upper, double thickness_mm, const TissueLayer& lower,
                                    double g, double eta);

/// Every upper layer on every lower one, rows of `lowers`: each layer is doubled only once, which takes a
/// tenth of the time.
[[nodiscard]] std::vector<double> layered_albedos(std::span<const TissueLayer> uppers, double thickness_mm,
                                                  std::span<const TissueLayer> lowers, double g, double eta);

}  // namespace dermis::inline optics::tissue
