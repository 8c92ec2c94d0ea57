#pragma once
// The parts of the head. Each takes the distance so far at a point and returns the distance with itself
// added. All in the symmetric standard head's frame: mm, x to the head's left, y up, z to the front, the ear
// axis at the origin.

#include "subjects/bust/params.h"
#include "subjects/bust/skull.h"
#include "subjects/bust/solids.h"
#include "subjects/bust/strokes.h"

namespace dermis::bust {

/// Neck with its muscles, and shoulders cut to a bust.
[[nodiscard]] double add_neck(double d, Point p);
/// The cut that ends the bust below.
[[nodiscard]] double cut_bust(double d, Point p);
/// Whether a point of the surface lies on that cut.
[[nodiscard]] bool on_cut(Point p);

/// Closed lids over the eyeballs (smooth; the slit and the folds are strokes).
[[nodiscard]] double add_eyes(double d, Point p);
/// Height of the closed lids' slit at a distance from the midline, between the corners of the eye at 15.5
/// and 48.
[[nodiscard]] double lid_slit_y(double x);
[[nodiscard]] double add_nose(double d, Point p);
/// To the solid that is cut out for the nostrils.
[[nodiscard]] double nostril_distance_mm(Point p);
/// Lips swell out of the face; see LipShape.
[[nodiscard]] double add_lips(double d, Point p, double fullness);

/// Where a point of the mouth region lies, by its x and y: for the shape and for the colour alike.
struct LipShape {
    double line_y, top_y, bottom_y;  ///< meeting line and the two vermilion borders at this x
    double upper_swell_mm, lower_swell_mm;
};
[[nodiscard]] LipShape lip_shape(double x);

class Ear {
  public:
    Ear(double length_mm, double protrusion_rad);
    [[nodiscard]] double add(double d, Point p) const;
    /// Ear frame: x back along the ear, y up along it, z away from its plane.
    [[nodiscard]] Point to_ear(Point p) const;
    /// The left ear's point at ear coordinates q.
    [[nodiscard]] Point to_head(Point q) const;
    /// Whether a point of the surface is on the ear, up to the creases where it meets the head;
    /// `head_distance` is the distance to the head without ears.
    [[nodiscard]] bool on_ear(Point p, double head_distance) const;

  private:
    [[nodiscard]] double plate(Point q) const;
    [[nodiscard]] double outline(double u, double v) const;

    double scale_;
    Point origin_, back_, up_, out_;
    std::vector<Point> outline_;
    StrokeLayer relief_;  ///< height of the plate's middle, drawn at z = 0 of the ear frame
    Tube helix_, antihelix_, crus_;
};

/// Large forms under the features: brow, orbits, cheekbones, temples, jaw, chin.
void add_form_strokes(StrokeLayer& layer, const StrokeLayer::Snap& snap);
/// Folds and creases over the features: lids, wings of the nose, philtrum, corners of the mouth, neck.
void add_detail_strokes(StrokeLayer& layer, const StrokeLayer::Snap& snap);

}  // namespace dermis::bust
