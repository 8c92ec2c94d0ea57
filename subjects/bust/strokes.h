#pragma once
// A sculptor's brush: raised or carved strokes along curves, added to a distance field.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "subjects/bust/point.h"

namespace dermis::bust {

/// A control point of a stroke: where it runs, the radius it reaches and how far it lifts the surface there.
struct StrokePoint {
    Point at;
    double radius_mm = 1;
    double lift_mm = 0;  ///< positive raises, negative carves
};

enum class Mirror { no, yes };

/// Sum of kernels lift * (1 - (distance / radius)^2)^3 along Catmull-Rom curves (a convolution surface: no
/// crease on the inside of a bend, ends that fade out). Cost of at(): about 5 ns a kernel in reach.
class StrokeLayer {
  public:
    /// Moves a point of a curve onto the surface that the strokes are to lie on.
    using Snap = std::function<Point(Point)>;

    void add(std::span<const StrokePoint> curve, Mirror mirror, const Snap& snap);
    /// Call once, after the last add().
    void build();
    /// Millimetres to subtract from the distance at `p`.
    [[nodiscard]] double at(Point p) const;

  private:
    struct Dab {
        Point at;
        double inverse_radius2, lift, radius;
    };
    static constexpr double kCellMm = 6;

    [[nodiscard]] int cell_of(Point p) const;

    std::vector<Dab> dabs_;
    Point low_;
    std::array<int, 3> cells_ = {0, 0, 0};
    std::vector<int> first_;  ///< per cell, into entries_
    std::vector<Dab> entries_;
};

}  // namespace dermis::bust
