#pragma once
// How a technique reads the textures "diffused_normals_red" and "diffused_normals_green"
// (PassList::diffused_normals; render/diffused_normals.h bakes them).

#include "dermis/base/vec.h"
#include "dermis/optics/profile.h"
#include "dermis/technique/pass_list.h"

namespace dermis {

/// The weight of the pixel's own normal in each channel's mean, the stored one having the rest: what the
/// narrow Gaussians have of the profile. Blue takes green's stored normal, with so much less weight that the
/// mean's length on a sphere is blue's, to first order: it is hardly wider than a texel anywhere.
[[nodiscard]] Vec3 own_normal_weights(const GaussianSum& profile, const DiffusedNormalsRequest& request);

}  // namespace dermis
