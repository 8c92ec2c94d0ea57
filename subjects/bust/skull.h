#pragma once
// The head without nose, eyes, lips and ears: one smooth radius over all directions from a point inside.

#include <vector>

#include "subjects/bust/point.h"

namespace dermis::bust {

/// Bicubic B-spline over (polar angle from +Y, azimuth from +Z), symmetric in x and smooth across the poles,
/// fitted by regularised least squares to horizontal sections of an average head.
class Skull {
  public:
    Skull();
    /// First-order distance: (r - R) / |gradient of it|. Good within some 20 mm of the surface.
    [[nodiscard]] double distance_mm(Point p) const;

  private:
    struct Value {
        double radius, by_polar, by_azimuth;
    };
    [[nodiscard]] Value evaluate(double polar, double azimuth) const;

    std::vector<double> coefficients_;
};

}  // namespace dermis::bust
