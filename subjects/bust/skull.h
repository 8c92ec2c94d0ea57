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
    /// Root-mean-square distance of the fit from the section table.
    [[nodiscard]] double fit_rms_mm() const { return fit_rms_mm_; }

  private:
    struct Value {
        double radius, by_polar, by_azimuth;
    };
    [[nodiscard]] Value evaluate(double polar, double azimuth) const;

    std::vector<double> coefficients_;
    double fit_rms_mm_ = 0;
};

}  // namespace dermis::bust
