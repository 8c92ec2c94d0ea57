#pragma once
// How a technique reads the textures "diffused_normals_red" and "diffused_normals_green"
// (PassList::diffused_normals; render/diffused_normals.h bakes them).

#include "dermis/base/vec.h"
#include "dermis/optics/profile.h"
#include "dermis/technique/pass_list.h"

namespace dermis {

/// The weight of the pixel's own normal in each channel's mean, the stored one having the rest. To first
/// order the mean on a sphere is then as long as with the whole profile: the normals spread less over the
/// narrow Gaussians, which the stored normal lacks, but not by nothing, so that it counts for more than the
/// wide ones alone have of the profile. Blue takes green's stored normal: it is hardly wider than a texel
/// anywhere.
[[nodiscard]] Vec3 own_normal_weights(const GaussianSum& profile, const DiffusedNormalsRequest& request);

}  // namespace dermis
