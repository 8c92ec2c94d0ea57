#pragma once
// The kernel of the separable blur's own code, and its width for a skin.

#include "dermis/optics/profile.h"

namespace dermis::inline optics {

/// Jimenez et al. 2015, Separable Subsurface Scattering, as its code has it: the part `strength` of the light
/// is spread by the five wide Gaussians that GPU Gems 3 has for red, widened by 0.001 + falloff. The rest is
/// not spread.
struct ArtisticKernel {
    Rgb strength = {0.48, 0.41, 0.28};
    Rgb falloff = {1, 0.37, 0.3};
};

/// Its shares of the light along a line, as Gaussians whose weights sum to 1 in each channel; a variance of 0
/// is light that is not spread. The published code uses Gaussians that are normalised over the plane, 1 / (2
/// pi v), along a line, so each counts as w / sqrt(v).
[[nodiscard]] GaussianSum line_kernel(const ArtisticKernel& kernel);

/// The mean square distance of its light along a line in mm^2, 0 for what is not spread. The code cuts the
/// spread part off at `reach_mm` on both sides and normalises it: 3 with 25 taps. Infinite: not cut off.
[[nodiscard]] Rgb mean_square_along_line_mm2(const ArtisticKernel& kernel, double reach_mm);

struct KernelWidth {
    double width = 0;  ///< factor on all lengths of the kernel
    /// The captured share of the skin's blur of slowly varying light: 1 - rms error of the kernel's change /
    /// rms of the skin's change, over all channels, of light times the skin's albedo.
    double share = 0;
};

/// The width of a kernel, by its mean squares along a line, at which it blurs light that varies slowly most
/// as the skin does: such a blur changes light by half of the mean square times the second derivative.
[[nodiscard]] KernelWidth fitted_width(const Rgb& kernel_mm2, const Profile& skin);

}  // namespace dermis::inline optics
