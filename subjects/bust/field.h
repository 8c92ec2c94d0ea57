#pragma once
// The built-in head as a distance field: exact normals, curvature and thickness, whatever the mesh.

#include "subjects/bust/params.h"
#include "subjects/bust/parts.h"

namespace dermis {

/// Distance (mm, negative inside) to the surface of a bust. The zero set is the surface; away from it the
/// value is a first-order distance (the gradient's length is 1 within about a third on the surface).
/// Immutable and safe to share between threads; about half a microsecond a point. Y up, faces +Z, origin
/// between the ears.
class BustField {
  public:
    /// Parameters must have passed check_bust_params.
    explicit BustField(const BustParams& params);

    [[nodiscard]] double distance_mm(bust::Point p) const;
    /// Central differences of distance_mm.
    [[nodiscard]] bust::Point gradient(bust::Point p) const;
    /// Outward unit normal of the level set through p.
    [[nodiscard]] bust::Point normal(bust::Point p) const { return bust::unit(gradient(p)); }
    /// Newton along the gradient to the surface; good from within 10 mm.
    [[nodiscard]] bust::Point project(bust::Point p, int steps) const;
    /// Signed mean curvature of the level set through p, half the divergence of the unit gradient; positive
    /// where convex. `step_mm` is the stencil: detail below it is smoothed away.
    [[nodiscard]] double mean_curvature_per_mm(bust::Point p, double step_mm = 0.1) const;
    /// Length of the inward ray from the surface point p along -normal to the next surface, at most
    /// `most_mm`.
    [[nodiscard]] double thickness_mm(bust::Point p, double most_mm = 50) const;

    /// A world point in the symmetric standard head that all parts and skin maps are drawn on.
    [[nodiscard]] bust::Point to_standard(bust::Point p_world) const;
    [[nodiscard]] const bust::Ear& ear() const { return ear_; }
    /// For a point of the surface, in the standard head.
    [[nodiscard]] bool on_ear(bust::Point p_standard) const {
        return ear_.on_ear(p_standard, solids(p_standard));
    }

  private:
    [[nodiscard]] double forms(bust::Point p) const;
    [[nodiscard]] double solids(bust::Point p) const;

    BustParams params_;
    bust::Skull skull_;
    bust::Ear ear_;
    bust::StrokeLayer form_strokes_, detail_strokes_;
    double phase_[6];
};

}  // namespace dermis
