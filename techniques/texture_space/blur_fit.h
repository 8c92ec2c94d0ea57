#pragma once
// Radii and colours of a blur by a few passes, from the diffusion profile that they are to imitate.
//
// A pass replaces a share a_c of the light of every colour c by the mean of its taps around the point, which
// leaves t(f) of a wave of frequency f, by the distances of the taps: one pass leaves 1 - a_c + a_c t(f), and
// passes multiply. The profile leaves the sum of w_c exp(-v x) over its Gaussians, x = 2 pi^2 f^2. Shares are
// least squares over x, relative to what the profile takes (wave_importance()); radii are a geometric series,
// the best of a grid. (Taps taken as a Gaussian of their variance left .48 instead of .58 of waves of 5 mm in
// red.)

#include <numbers>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/optics/profile.h"

namespace dermis::texture_space {

struct BlurPass {
    float radius = 0;        ///< mm, or texels
    Vec3 share = {1, 1, 1};  ///< of the light that the taps replace, a colour each
};

/// Taps at one distance from the centre, in radii, and their part of all taps' weight.
struct TapRing {
    double distance = 1, weight = 1;
};

/// Along one axis, at radius 1.
[[nodiscard]] double tap_variance(const std::vector<TapRing>& rings);

struct BlurFitSettings {
    int passes = 3;
    /// Of the filter, without the centre. These are those of filter=gaussian.
    std::vector<TapRing> rings = {{1, 2.0 / 3}, {std::numbers::sqrt2, 1.0 / 3}};
    double texel_mm = 0.3;   ///< of the light map: reading between texels blurs too
    bool read_blurs = true;  ///< the last reading too; not where the pixel has what it takes away
};

/// Narrowest first; a pass that would replace less than a hundredth of every colour is left out, so that
/// there may be none. A profile without terms has none.
[[nodiscard]] std::vector<BlurPass> fit_blur(const GaussianSum& profile, const BlurFitSettings& settings);

/// What the passes leave of a wave: x is 2 pi^2 f^2 in 1/mm^2.
[[nodiscard]] Vec3 blur_transfer(const std::vector<BlurPass>& passes, const BlurFitSettings& settings,
                                 double x);

/// How many of `variances_texels`, in turn, come nearest to the profile when all of them blur every colour
/// alike.
[[nodiscard]] int nearest_pass_count(const GaussianSum& profile, const std::vector<double>& variances_texels,
                                     double texel_mm);

}  // namespace dermis::texture_space
