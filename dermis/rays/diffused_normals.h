#pragma once
// The normals of the skin as scattering sees them (Ma et al. 2007, "Rapid Acquisition of Specular and Diffuse
// Normal Maps": the diffuse normals of each colour): for each texel and channel the mean of the normals
// around it, weighted by the diffusion profile. Its length is kept: it is shorter than 1 where the normals
// differ.
//
// Light that no surface blocks and that is above the horizon of all these normals is linear in the normal, so
// the mean's cosine is the scattered light, exactly. Near the terminator the spread counts too:
// techniques/preintegrated/diffused_normals.glsl says how.
//
// The Gaussians narrower than `finest_variance_mm2` are left to the pixel, which reads the normal map itself:
// a texel could not hold them.

#include <array>
#include <cstdint>
#include <vector>

#include "dermis/optics/diffused_normals.h"
#include "dermis/rays/skin_points.h"

namespace dermis::inline rays {

/// Texels by which each chart is grown.
inline constexpr int kDiffusedNormalsGutter = 16;

/// n * 0.5 + 0.5 in 16 bits, n in the scene's axes. In alpha, as x * 0.5 + 0.5, how the spread of red's
/// normals differs from an even one: in the frame of techniques/preintegrated/diffused_normals.glsl around
/// the mean, the spread is half of its trace times [[1 + p, q], [q, 1 - p]]. Red holds p, green q.
struct DiffusedNormals {
    using Texel = std::array<uint16_t, 4>;
    int size = 0;
    std::vector<Texel> red, green;
};

/// Over all skin of the scene; cached by content. Distances are straight; a way that leaves the flesh and
/// enters it again on a wall that faces elsewhere, as between lips, does not count. Errors: a map
/// that cannot be read, the ray library fails. Cost: 6 s of processor time for the bust.
[[nodiscard]] Result<DiffusedNormals> bake_diffused_normals(const Scene& scene, const GaussianSum& profile,
                                                            const DiffusedNormalsRequest& request);

}  // namespace dermis::inline rays
