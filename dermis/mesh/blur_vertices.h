#pragma once
// Values at vertices blurred over the surface.

#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// `values`, one a vertex, blurred by about a Gaussian of `variance_mm2` an axis along the surface, 0 or
/// more. Vertices at one place are one, so that UV seams do not show. Linear, keeps constants and, weighted
/// by area, the sum.
///
/// Heat on the surface (Desbrun et al. 1999, "Implicit Fairing of Irregular Meshes"): two implicit steps of
/// (A + t L) u' = A u with the areas A, the cotangent Laplacian L (negative weights counted as 0), and
/// t = variance / 4. The kernel has the Gaussian's variance, a sharper peak and longer tails.
[[nodiscard]] Result<std::vector<float>> blur_over_surface(const Mesh& mesh, std::span<const float> values,
                                                           double variance_mm2);

}  // namespace dermis::inline mesh
