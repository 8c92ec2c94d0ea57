#pragma once
// Brows and lashes: single hairs drawn as tapering strokes over the face, seen from the front.

#include <array>
#include <cstdint>
#include <vector>

#include "subjects/bust/point.h"

namespace dermis::bust {

/// 720 hairs a brow and 90 a lid, different left and right. Immutable; safe to share between threads.
class Hairs {
  public:
    explicit Hairs(uint32_t seed);
    /// 0 bare skin to 1 wholly covered, at a point of the face (the standard head); about 0.1 microseconds.
    [[nodiscard]] float cover(Point p_standard) const;

  private:
    struct Stroke {
        Point from, to;  ///< x away from the midline, y up
        double half_width_from, half_width_to, opacity;
    };
    struct Side {
        std::vector<std::vector<Stroke>> cells;
    };
    void grow_brow(Side& side, uint32_t seed);
    void grow_lashes(Side& side, uint32_t seed);
    void grow(Side& side, const std::array<Point, 3>& curve, double half_width_mm, double opacity);

    Side left_, right_;
};

}  // namespace dermis::bust
