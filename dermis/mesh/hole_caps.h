#pragma once
// The open borders of a set of triangles, and triangles that close them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/vec.h"

namespace dermis {

/// One closed border: positions in the order in which its triangles turn, so that a cap that turns the other
/// way continues the surface.
using BorderLoop = std::vector<Vec3>;

/// Edges that only one of the chosen triangles has, joined to loops. Positions that are exactly equal are one
/// vertex, so UV seams are no border. `triangles` are numbers into `indices`. Where several borders meet at
/// one vertex each loop takes the first edge that is left, so every border edge is in exactly one loop or in
/// a chain that does not close, which is left out.
[[nodiscard]] std::vector<BorderLoop> border_loops(std::span<const Vec3> positions_mm,
                                                   std::span<const uint32_t> indices,
                                                   std::span<const uint32_t> triangles);

/// The triangulation of the loop of smallest area, facing as its surface does: size() - 2 triangles.
/// Barequet, Sharir 1995, Filling Gaps in the Boundary of a Polyhedron. Cubic time, so above `largest_exact`
/// vertices every second one is cut off first, until the rest is small enough.
inline constexpr size_t kLargestExactLoop = 400;
[[nodiscard]] std::vector<std::array<Vec3, 3>> cap_of(const BorderLoop& loop,
                                                      size_t largest_exact = kLargestExactLoop);

/// The largest_exact with which the caps of all loops together take a few seconds: kLargestExactLoop but for
/// a mesh of thousands of long borders.
[[nodiscard]] size_t affordable_exact(std::span<const BorderLoop> loops);

}  // namespace dermis
