#pragma once
// The one-dimensional kernel of the separable blur.

#include "dermis/base/vec.h"
#include "dermis/optics/profile.h"

namespace dermis::screen_space_separable {

/// A kernel of two Gaussians that an artist sets: (1 - far_share) G(near_mm) + far_share G(far_mm).
struct TwoGaussians {
    float near_mm = 0.3f;
    float far_mm = 2;
    Vec3 far_share = {0.6f, 0.35f, 0.2f};
};

/// As a profile whose weights sum to 1 in each channel.
[[nodiscard]] GaussianSum to_gaussian_sum(const TwoGaussians& kernel);

/// Where the kernel is cut off: a multiple of its widest standard deviation; 1 without any Gaussian.
[[nodiscard]] float reach_mm(const GaussianSum& profile, float width);

/// The part of the light that the line spread function has within `distance_mm` on both sides: sum of
/// w erf(d / sqrt(2 v)) over sum of w. The line spread function is the profile integrated over one direction;
/// a shadow's edge shows it. Lengths of the profile are multiplied by `width`. Source: Jimenez et al. 2015,
/// Separable Subsurface Scattering, section 4 (pre-integrated kernel).
[[nodiscard]] double share_within(const GaussianSum& profile, float width, int channel, double distance_mm);

}  // namespace dermis::screen_space_separable
