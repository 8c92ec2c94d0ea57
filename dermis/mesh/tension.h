#pragma once
// Tension of a mesh in a pose: how much its surface is stretched or compressed against the rest pose.

#include <span>
#include <vector>

#include "dermis/mesh/mesh.h"
#include "shaders/include/posing.h"

namespace dermis::inline mesh {

using posing::kMostTension;

/// The area around each vertex of a mesh at rest, over the welded topology.
struct RestAreas {
    std::vector<uint32_t> place;  ///< of each vertex; vertices of a seam share one
    std::vector<float> areas;     ///< twice that of the triangles around each place, mm2
};
[[nodiscard]] RestAreas rest_areas(std::span<const Vec3> rest_positions_mm,
                                   std::span<const uint32_t> indices);

/// ln(area in the pose / area at rest) of the triangles around each vertex: 0 at rest and in rigid motion,
/// below 0 compressed, above 0 stretched. It is the sum of the logarithms of the two principal stretches, the
/// trace of Hencky's strain (1928, "Über die Form des Elastizitätsgesetzes bei ideal elastischen Stoffen"),
/// so that it does not depend on the triangulation or on the direction of a stretch. A stretch in one
/// direction that a compression across it makes up for (shear) has none. Raman et al. 2023 ("Mesh-tension
/// driven expression-based wrinkles for synthetic faces") blend wrinkles by such a measure.
///
/// `indices`: the triangles of the mesh that rest_areas() saw; positions in its order.
[[nodiscard]] std::vector<float> compute_tensions(const RestAreas& rest, std::span<const Vec3> positions_mm,
                                                  std::span<const uint32_t> indices);

}  // namespace dermis::inline mesh
