#pragma once
// Which part of a profile a map of mean normals holds (rays/diffused_normals.h bakes it), and how a shader
// mixes it with the pixel's own normal.

#include "dermis/base/vec.h"
#include "dermis/optics/profile.h"

namespace dermis::inline optics {

/// Which map of mean normals to bake over the skin's atlas (rays/diffused_normals.h): `size` texels a side.
struct DiffusedNormalsRequest {
    int size = 1024;
    /// Along an axis; what is narrower is left to the pixel's own normal.
    float finest_variance_mm2 = 0.1f;
    friend bool operator==(const DiffusedNormalsRequest&, const DiffusedNormalsRequest&) = default;
};

/// The weight of the pixel's own normal in each channel's mean, the stored one having the rest. To first
/// order the mean on a sphere is then as long as with the whole profile: the normals spread less over the
/// narrow Gaussians, which the stored normal lacks, but not by nothing, so that it counts for more than the
/// wide ones alone have of the profile. Blue takes green's stored normal: it is hardly wider than a texel
/// anywhere.
[[nodiscard]] Vec3 own_normal_weights(const GaussianSum& profile, const DiffusedNormalsRequest& request);

/// 1 - length of green's stored mean over that of red's, to first order and exactly so on a sphere that is
/// large against the profile: the ratio of what the stored Gaussians spread. 0 where green has none.
[[nodiscard]] float green_spread(const GaussianSum& profile, const DiffusedNormalsRequest& request);

}  // namespace dermis::inline optics
