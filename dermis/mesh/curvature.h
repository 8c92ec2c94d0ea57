#pragma once
// How a mesh bends: the curvature tensor, and the signed mean curvature.

#include <vector>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// Over which curvature for shading is averaged. Of 3 mm and 1.8 mm the smaller captures more of
/// the effect of scattering: bust .134 against .112, head scan .227 against .220 (`preintegrated`, 128 and
/// 160 pixels).
inline constexpr double kCurvatureSmoothingMm = 1.8;

/// Mean curvature (k1 + k2) / 2 at every vertex in 1/mm: positive where convex, 1/R on a sphere of radius R,
/// 1/(2 R) on a cylinder, 0 on a plane and on a minimal surface. Needs normals (for the sign only).
///
/// A quadratic height over the tangent plane is fitted by least squares to the vertices around (Cazals and
/// Pouget 2005, "Estimating differential quantities using polynomial fitting of osculating jets", degree 2,
/// here with a term in the height that makes spheres exact); H follows from its derivatives (do Carmo 1976,
/// section 3-3). Neighbours are found by walking edges of the position-welded mesh, so UV seams do not show
/// and lips that touch do not mix.
///
/// `smoothing_mm` 0 fits the two rings around a vertex. Above 0 the fit takes everything within twice that
/// distance along the surface, weighted by a Gaussian of that standard deviation: noise and pores average
/// out, and features narrower than about twice the length with them. No fit takes more than the 1500 nearest
/// vertices; where fewer than twelve lie within reach it takes the two rings, and where the vertices do not
/// determine a surface the curvature is 0.
///
/// Measured worst errors: sphere 0.05 % (any tessellation), cylinder of 96 segments 0.24 %, torus of ratio 3
/// and 192 x 192 segments 0.8 % of its largest curvature; they fall with the square of the edge length. Noise
/// of 0.05 mm on a sphere of 80 mm with edges of 2.5 mm: a smoothing of 5 mm brings the typical error below
/// 10 %.
///
/// Cost: 20 ms for 9,000 vertices unsmoothed on one core; all cores are used.
[[nodiscard]] std::vector<float> compute_curvature(const Mesh& mesh, double smoothing_mm = 0);

/// The whole tensor by the same fit; compute_curvature() is half its trace.
[[nodiscard]] std::vector<CurvatureTensor> compute_curvature_tensors(const Mesh& mesh,
                                                                     double smoothing_mm = 0);

}  // namespace dermis::inline mesh
