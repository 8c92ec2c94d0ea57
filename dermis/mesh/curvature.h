#pragma once
// Curvature of a mesh: the tensor and the signed mean curvature.

#include <vector>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// Standard deviation of the smoothing of curvature for shading, chosen for the captured share of
/// `preintegrated` on bust and head scan.
inline constexpr double kCurvatureSmoothingMm = 1.8;

/// Mean curvature (k1 + k2) / 2 at every vertex in 1/mm: positive where convex, 1/R on a sphere of radius R,
/// 1/(2 R) on a cylinder, 0 on a plane and on a minimal surface. Needs normals (for the sign only).
///
/// Fits a quadratic height over the tangent plane to the vertices around (Cazals and Pouget 2005, "Estimating
/// differential quantities using polynomial fitting of osculating jets", degree 2, with a term that makes
/// spheres exact); H follows from its derivatives (do Carmo 1976, section 3-3). Neighbours are found along
/// edges of the position-welded mesh, so UV seams do not show and touching lips do not mix.
///
/// `smoothing_mm` 0 fits the two rings around a vertex. Above 0 the fit takes vertices within twice that
/// distance along the surface (1500 at most), weighted by a Gaussian of that standard deviation. With fewer
/// than twelve it takes the two rings; if the vertices determine no surface, the curvature is 0.
///
/// Worst errors: sphere 0.05 % (any tessellation), cylinder of 96 segments 0.24 %, torus of ratio 3 and 192 x
/// 192 segments 0.8 % of its largest curvature; they fall with the square of the edge length.
///
/// Cost: 20 ms for 9,000 vertices unsmoothed on one core; all cores are used.
[[nodiscard]] std::vector<float> compute_curvature(const Mesh& mesh, double smoothing_mm = 0);

/// The whole tensor by the same fit; compute_curvature() is half its trace.
[[nodiscard]] std::vector<CurvatureTensor> compute_curvature_tensors(const Mesh& mesh,
                                                                     double smoothing_mm = 0);

}  // namespace dermis::inline mesh
