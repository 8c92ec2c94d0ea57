#pragma once
// The texels whose centres lie in a triangle of a UV layout.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dermis/base/vec.h"

namespace dermis::inline mesh {

/// A rectangle of texels, rows from the top.
struct TexelGrid {
    int width = 0, height = 0;
};

/// Twice the signed area of (a, b, p). In double: at 16384 texels floats would leave gaps.
inline double twice_area(const std::array<double, 2>& a, const std::array<double, 2>& b, double x, double y) {
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

/// Top-left rule for a triangle of positive area in a y-down raster: edges that run up, or to the right when
/// horizontal, own their points.
inline bool owns_centres(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return b[1] < a[1] || (b[1] == a[1] && b[0] > a[0]);
}

/// Calls visit(x, y, v, w) for each texel of `grid` whose centre lies in the triangle with these corners, in
/// texels; v and w are the weights of the second and third corner. A centre on a shared edge belongs to one
/// side only.
template <class Visit>
void visit_texels_of(const std::array<std::array<double, 2>, 3>& corners, TexelGrid grid, Visit&& visit) {
    auto p = corners;
    double area = twice_area(p[0], p[1], p[2][0], p[2][1]);
    if (area == 0 || !std::isfinite(area)) return;
    const bool flipped = area < 0;
    if (flipped) std::swap(p[1], p[2]), area = -area;
    const auto range = [&](size_t axis, int size) {
        const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
        return std::pair{int(std::clamp(std::floor(low - 0.5), 0.0, double(size))),
                         int(std::clamp(std::ceil(high), -1.0, double(size - 1)))};
    };
    const auto [x0, x1] = range(0, grid.width);
    const auto [y0, y1] = range(1, grid.height);
    const std::array<bool, 3> own = {owns_centres(p[1], p[2]), owns_centres(p[2], p[0]),
                                     owns_centres(p[0], p[1])};
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const std::array<double, 3> w = {twice_area(p[1], p[2], x + 0.5, y + 0.5),
                                             twice_area(p[2], p[0], x + 0.5, y + 0.5),
                                             twice_area(p[0], p[1], x + 0.5, y + 0.5)};
            bool inside = true;
            for (size_t i = 0; i < 3; ++i) inside = inside && (w[i] > 0 || (w[i] == 0 && own[i]));
            if (!inside) continue;
            const double second = w[1] / area, third = w[2] / area;
            visit(x, y, flipped ? third : second, flipped ? second : third);
        }
}

}  // namespace dermis::inline mesh
