#pragma once
// Plain triangles while the bust is being meshed.

#include <array>
#include <functional>
#include <vector>

#include "subjects/bust/point.h"

namespace dermis::bust {

struct Surface {
    std::vector<Point> points;
    std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
};

struct Box {
    Point low, high;
};

/// Marching tetrahedra over a regular grid (six a cube, so the result is a closed manifold): the zero set of
/// `distance` inside `box`, which it must not touch. Cubes further from the surface than twice what the
/// distance says are skipped unseen.
[[nodiscard]] Surface extract_surface(const std::function<double(Point)>& distance, Box box, double cell_mm);

}  // namespace dermis::bust
