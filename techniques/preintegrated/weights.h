#pragma once
// How much each of several reads counts in each channel, from the profile: two levels of the normal map, four
// blurs of the occlusion, the places around a point where shadow=gathered looks.

#include <array>
#include <vector>

#include "dermis/optics/preintegration.h"

namespace dermis::preintegrated {

/// Weights of the smoother normal, 0..1 for each channel, and its mip levels above the sharp one.
///
/// Penner 2011 mixes one normal per channel, with weights by eye, as d'Eon, Luebke 2007 and Hable 2010 do.
/// Here they follow from the profile. A read at a mip level averages a box of b mm, of variance b^2 / 12
/// along one axis. Light scattered by a sum of Gaussians sees the bumps through the kernel T = sum w_i
/// G(v_i). The blend sees them through (1 - x) G(s0) + x G(s1), with the variances s0 and s1 of the two
/// reads. x makes the two nearest in the mean square for relief along a line whose power falls as the square
/// of the frequency, as that of wrinkles and folds does:
///
///     x = <G(s0) - T(s0), G(s0) - G(s1)> / |G(s0) - G(s1)|^2,   <G(a), G(b)> = -(a + b)^(1/2)
///
/// The inner product leaves out a constant that cancels in differences. A white spectrum would have
/// (2 pi (a + b))^(-1/2), with which green and blue lose relief that they keep.
struct NormalBlend {
    Rgb weight = {};
    double lod_bias = 0;
};

/// The widest smoother read: half as wide as a box with the widest channel's variance. A wider one averages
/// what the table of curvature holds already, and over the map's seams.
[[nodiscard]] double widest_blend_mm(const GaussianSum& profile);

/// `sharp_mm` is what one texel of the sharp read covers on the skin, above 0. The smoother read is at most
/// kPublishedNormalLevels above it.
[[nodiscard]] NormalBlend normal_blend(const GaussianSum& profile, double sharp_mm);

/// With the mip bias of the published shader, kPublishedNormalLevels whatever the texel's size.
[[nodiscard]] NormalBlend published_normal_blend(const GaussianSum& profile, double sharp_mm);

/// Weights of the vertices' three blurred occlusions (kOcclusionVariance0Mm2 and following) per channel; the
/// rest to 1 is the weight of the unblurred occlusion. A Gaussian of the profile is replaced by a mix of the
/// two with the nearest variances. The mix has the Gaussian's own variance v, so it damps long waves by the
/// same 1 - 2 pi^2 v / wavelength^2.
[[nodiscard]] std::array<Rgb, 3> occlusion_blend(const GaussianSum& profile);

struct ShadowTap {
    Rgb weight = {};
    double penumbra_weight = 0;  ///< of the light at the point itself, whose shadow is filtered; 1 on average
    double radius_mm = 0;        ///< on the skin
};

/// kShadowGatherTaps of them, from the nearest to the farthest. Light of a penumbra whose disk is
/// kLightEdgeMm wide, scattered by the profile, reaches a point by R convolved with the disk. The taps are at
/// even steps of that function's integral in the channel that scatters farthest, where each weight is 1. In
/// the other channels, and for the disk alone, a weight is the quotient of the functions. Gaussians narrower
/// than a tap can see count as wide as that.
[[nodiscard]] std::vector<ShadowTap> shadow_taps(const GaussianSum& profile);

/// A Gaussian of this variance along an axis, convolved with a disk, at a distance from the disk's middle:
/// per mm^2. Within 1e-6 of its largest value for radii of up to six standard deviations.
[[nodiscard]] double gaussian_over_disk(double variance_mm2, double disk_radius_mm, double distance_mm);

}  // namespace dermis::preintegrated
