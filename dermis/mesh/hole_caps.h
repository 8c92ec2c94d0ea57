#pragma once
// The open borders of a set of triangles, and triangles that close them.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/vec.h"

namespace dermis::inline mesh {

/// One closed border: positions in the winding order of its triangles; a cap of the opposite order continues
/// the surface.
using BorderLoop = std::vector<Vec3>;

/// Joins the edges of only one of the chosen triangles to loops. Equal positions are one vertex, so UV seams
/// are not borders. `triangles` are numbers into `indices`. Where borders meet at a vertex, each loop takes
/// the first free edge: every border edge is in exactly one loop, or in a chain that does not close, which is
/// left out.
[[nodiscard]] std::vector<BorderLoop> border_loops(std::span<const Vec3> positions_mm,
                                                   std::span<const uint32_t> indices,
                                                   std::span<const uint32_t> triangles);

/// The order in which loops are looked up; any order would do.
struct LoopOrder {
    bool operator()(const BorderLoop& a, const BorderLoop& b) const;
};

/// Moves the loops that are among `known` behind the others; both parts keep their order. Returns the number
/// of loops before them. Takes n log n comparisons: a head can have thousands of hair cards with a border
/// each.
template <class Order = LoopOrder>
[[nodiscard]] size_t put_last(std::vector<BorderLoop>& loops, std::vector<BorderLoop> known,
                              const Order& order = {}) {
    std::sort(known.begin(), known.end(), order);
    // Ranges' own partition returns a subrange, which clang 14 does not compile.
    const auto from = std::stable_partition(loops.begin(), loops.end(), [&](const BorderLoop& loop) {
        return !std::binary_search(known.begin(), known.end(), loop, order);
    });
    return size_t(from - loops.begin());
}

/// The loop's triangulation of smallest area, facing as its surface does: size() - 2 triangles. Barequet,
/// Sharir 1995, Filling Gaps in the Boundary of a Polyhedron. Cubic time: while there are more than
/// `largest_exact` vertices, every second one is cut off.
inline constexpr size_t kLargestExactLoop = 400;
[[nodiscard]] std::vector<std::array<Vec3, 3>> cap_of(const BorderLoop& loop,
                                                      size_t largest_exact = kLargestExactLoop);

/// The largest_exact with which all caps together take a few seconds: kLargestExactLoop, or less for a mesh
/// of thousands of long borders.
[[nodiscard]] size_t affordable_exact(std::span<const BorderLoop> loops);

}  // namespace dermis::inline mesh
