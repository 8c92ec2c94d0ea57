#pragma once
// How a technique reads the normals that it asks for by PassList::diffused_normals (render/diffused_normals.h
// bakes them).

#include <array>

#include "dermis/base/vec.h"
#include "dermis/optics/profile.h"
#include "dermis/technique/pass_list.h"

namespace dermis::inline technique {

/// Red's mean normal: its direction, n * .5 + .5, in rgb; of length 0 where there is no skin. Green's
/// direction less red's: of each part the root with its sign, from -1 at 1 / 255 to 1, in rgb; in alpha
/// sqrt(1 - length) of red's mean. How unevenly red's normals spread: p and q of render/diffused_normals.h, x
/// * .5 + .5.
inline constexpr std::array<const char*, 3> kDiffusedNormalsTextures = {
    "diffused_normals_red", "diffused_normals_green", "diffused_normals_uneven"};

/// The weight of the pixel's own normal in each channel's mean, the stored one having the rest. To first
/// order the mean on a sphere is then as long as with the whole profile: the normals spread less over the
/// narrow Gaussians, which the stored normal lacks, but not by nothing, so that it counts for more than the
/// wide ones alone have of the profile. Blue takes green's stored normal: it is hardly wider than a texel
/// anywhere.
[[nodiscard]] Vec3 own_normal_weights(const GaussianSum& profile, const DiffusedNormalsRequest& request);

/// 1 - length of green's stored mean over that of red's, to first order and exactly so on a sphere that is
/// large against the profile: the ratio of what the stored Gaussians spread. 0 where green has none.
[[nodiscard]] float green_spread(const GaussianSum& profile, const DiffusedNormalsRequest& request);

}  // namespace dermis::inline technique
