#pragma once
// Radii and colours of a blur by a few passes, from the diffusion profile that they are to imitate.
//
// A pass replaces a share a_c of the light of every colour c by the mean of its taps around the point, which
// leaves t(f) of a wave of frequency f, by the distances of the taps: one pass leaves 1 - a_c + a_c t(f), and
// passes multiply. The profile leaves the sum of w_c exp(-v x) over its Gaussians, x = 2 pi^2 f^2. Shares are
// least squares over x, relative to what the profile takes (wave_importance()); radii are a geometric series,
// the best of a grid.

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
    double texel_mm = 0.3;  ///< of the light map: reading between texels blurs too
};

/// Narrowest first; a pass that would replace less than a hundredth of every colour is left out, so that
/// there may be none. A profile without terms has none.
[[nodiscard]] std::vector<BlurPass> fit_blur(const GaussianSum& profile, const BlurFitSettings& settings);

/// What the passes leave of a wave: x is 2 pi^2 f^2 in 1/mm^2.
[[nodiscard]] Vec3 blur_transfer(const std::vector<BlurPass>& passes, const BlurFitSettings& settings,
                                 double x);

}  // namespace dermis::texture_space
