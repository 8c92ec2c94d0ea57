#pragma once
// Radii and colours of a blur by a few passes, from the diffusion profile that they are to imitate.
//
// A pass replaces a share a_c of the light of every colour c by the mean of its taps around the point. Taken
// as a Gaussian of variance s = tap_variance * radius^2, one pass damps a wave of frequency f by 1 - a_c +
// a_c exp(-s x), with x = 2 pi^2 f^2, and passes multiply. The profile damps it by the sum of w_c exp(-v x)
// over its Gaussians. Shares are least squares over x; radii are a geometric series, the best of a grid.

#include <vector>

#include "dermis/base/vec.h"
#include "dermis/optics/profile.h"

namespace dermis::texture_space {

struct BlurPass {
    float radius = 0;        ///< mm, or texels
    Vec3 share = {1, 1, 1};  ///< of the light that the taps replace, a colour each
};

struct BlurFitSettings {
    int passes = 3;
    double tap_variance = 0.35;  ///< along one axis, of taps of radius 1 without their centre
    double texel_mm = 0.3;       ///< of the light map: reading between texels blurs too
};

/// Narrowest first; a pass that would replace less than a hundredth of every colour is left out, so that
/// there may be none. A profile without terms has none.
[[nodiscard]] std::vector<BlurPass> fit_blur(const GaussianSum& profile, const BlurFitSettings& settings);

/// What the passes make of a wave, and what the profile does: x is 2 pi^2 f^2 in 1/mm^2.
[[nodiscard]] Vec3 blur_transfer(const std::vector<BlurPass>& passes, const BlurFitSettings& settings,
                                 double x);
[[nodiscard]] Vec3 profile_transfer(const GaussianSum& profile, double x);

/// How many of `variances_texels`, in turn, come nearest to the profile when all of them blur every colour
/// alike.
[[nodiscard]] int nearest_pass_count(const GaussianSum& profile, const std::vector<double>& variances_texels,
                                     double texel_mm);

}  // namespace dermis::texture_space
