// Lips: a swell of the face along the meeting line, whose outline gives the vermilion border as well.

#include <array>

#include "dermis/bust/parts.h"

namespace dermis::bust {
namespace {

// By distance from the midline: meeting line, upper border (cupid's bow), lower border, upper and lower
// swell.
struct Column {
    double x, line, top, bottom, upper, lower;
};
constexpr Column kColumns[] = {
    {0, -39.4, -31.8, -49.4, 4.6, 5.6},    {5.5, -38.7, -30.2, -49.3, 4.5, 5.7},
    {11, -38.3, -31.2, -48.0, 4.0, 5.0},   {16, -38.5, -33.2, -45.6, 3.1, 3.7},
    {20.5, -39.0, -35.9, -43.0, 1.9, 2.1}, {25.5, -39.8, -39.2, -40.7, 0.2, 0.2},
    {31, -40.2, -40.0, -40.4, 0, 0},
};

// Height across a lip, t = 0 at the meeting line, 1 at the vermilion border, 2.2 and more on plain skin.
double lip_profile(double t, double at_border) {
    if (t <= 0) return 0;
    constexpr double kRound = 0.34;
    const double rest = 1 - std::min(t / kRound, 1.0);
    const double rise = std::sqrt(1 - rest * rest);
    const double fall = mix(1, at_border, smooth_step(0.25, 1.15, t));
    return rise * fall * (1 - smooth_step(0.8, 2.5, t));
}

}  // namespace

LipShape lip_shape(double x) {
    const double ax = std::abs(x);
    size_t i = 0;
    while (i + 2 < std::size(kColumns) && ax > kColumns[i + 1].x) ++i;
    const double span = kColumns[i + 1].x - kColumns[i].x;
    const double t = std::clamp((ax - kColumns[i].x) / span, 0.0, 1.0);
    const auto at = [&](double Column::*member) {
        // Cubic Hermite with slopes by central differences; even at the midline.
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
    double swell = 0;
    // A floor under the meeting line keeps the crease between the lips about 3 mm deep.
    if (p.y > s.line_y)
        swell = s.upper_swell_mm * lip_profile((p.y - s.line_y) / std::max(s.top_y - s.line_y, 0.4), 0.5);
    else
        swell = s.lower_swell_mm * lip_profile((s.line_y - p.y) / std::max(s.line_y - s.bottom_y, 0.4), 0.3);
    const double floor_mm = 0.72 * std::min(s.upper_swell_mm, s.lower_swell_mm);
    const double near_line = 1 - smooth_step(0.0, 4.0, std::abs(p.y - s.line_y));
    swell = std::hypot(swell, floor_mm * near_line);
    return d - fullness * swell;
}

}  // namespace dermis::bust
