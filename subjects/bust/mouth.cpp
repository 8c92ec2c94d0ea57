// Lips: a bulge of the face along the meeting line, whose outline is also the vermilion border.

#include <array>

#include "subjects/bust/parts.h"

namespace dermis::bust {
namespace {

// By distance from the midline: meeting line, upper border (cupid's bow), lower border, upper and lower
// bulge.
struct Column {
    double x, line, top, bottom, upper, lower;
};
constexpr Column kColumns[] = {
    {0, -39.4, -32.5, -47.8, 2.6, 3.0},    {5.5, -38.4, -31.3, -47.6, 2.5, 3.1},
    {11, -38.1, -32.4, -46.2, 2.1, 2.4},   {16, -38.3, -34.1, -44.2, 1.5, 1.4},
    {20.5, -38.8, -36.1, -42.2, 0.9, 0.7}, {25.0, -39.4, -38.8, -40.2, 0.2, 0.1},
    {31, -40.2, -40.0, -40.4, 0, 0},
};

// Height across the upper lip, t = 0 at the meeting line, 1 at the vermilion border, more on plain skin: a
// plane that faces down, fullest just under the border.
double upper_profile(double t) {
    return std::sin(1.5708 * std::min(t / 0.72, 1.0)) * mix(1, 0.8, smooth_step(0.7, 1.3, t)) *
           (1 - smooth_step(0.9, 3.4, t));
}

// The lower lip is a roll, fullest at a third of its height.
double lower_profile(double t) {
    const double rest = 1 - std::min(t / 0.5, 1.0);
    return std::sqrt(1 - rest * rest * rest) * mix(1, 0.4, smooth_step(0.35, 1.4, t)) *
           (1 - smooth_step(0.9, 2.4, t));
}

}  // namespace

LipShape lip_shape(double x) {
    const double ax = std::abs(x);
    size_t i = 0;
    while (i + 2 < std::size(kColumns) && ax > kColumns[i + 1].x) ++i;
    const double span = kColumns[i + 1].x - kColumns[i].x;
    const double t = std::clamp((ax - kColumns[i].x) / span, 0.0, 1.0);
    const auto at = [&](double Column::*member) {
        // Cubic Hermite interpolation with central differences as slopes; symmetric at the midline.
        const auto slope = [&](size_t k) {
            if (k == 0 || k + 1 == std::size(kColumns)) return 0.0;
            return (kColumns[k + 1].*member - kColumns[k - 1].*member) /
                   (kColumns[k + 1].x - kColumns[k - 1].x);
        };
        const double a = kColumns[i].*member, b = kColumns[i + 1].*member;
        const double t2 = t * t, t3 = t2 * t;
        return a * (2 * t3 - 3 * t2 + 1) + b * (3 * t2 - 2 * t3) +
               span * (slope(i) * (t3 - 2 * t2 + t) + slope(i + 1) * (t3 - t2));
    };
    return {at(&Column::line), at(&Column::top), at(&Column::bottom), at(&Column::upper), at(&Column::lower)};
}

double add_lips(double d, Point p, double fullness) {
    if (std::abs(p.x) > 32 || p.y > -10 || p.y < -72 || p.z < 60 || std::abs(d) > 25) return d;
    const LipShape s = lip_shape(p.x);
    const double above = p.y - s.line_y;
    double swell = above > 0
                       ? s.upper_swell_mm * upper_profile(above / std::max(s.top_y - s.line_y, 0.4))
                       : s.lower_swell_mm * lower_profile(-above / std::max(s.line_y - s.bottom_y, 0.4));
    // The crease between the lips, with a rounded floor, deeper than the lips are thick.
    const double open = 1 - smooth_step(18, 27, std::abs(p.x));
    swell = std::hypot(swell, 0.3 * std::min(s.upper_swell_mm, s.lower_swell_mm) * bump(above / 4)) -
            open * 0.9 * bump(above / 1.3);
    return d - fullness * swell;
}

}  // namespace dermis::bust
