#include "dermis/optics/curve_2015.h"

#include <algorithm>
#include <cmath>

namespace dermis::inline optics {
namespace {

double saturate(double x) {
    return std::clamp(x, 0.0, 1.0);
}

// 0 at a radius of 2 mm, 1 at 16 mm.
double radius_share(double curvature_per_mm) {
    return (1 / std::clamp(curvature_per_mm, 0.0625, 0.5) - 2) / 14;
}

// r = 2 mm: a parabola (a cubic in blue) on the dark side that blends into a line on the lit side.
TightPieces tight_pieces(size_t c, double x) {
    constexpr double kLow[3] = {0, 0.3, 0.3}, kHigh[3] = {1, 0.7, 0.7}, kOffset[3] = {0, 0.06, 0.06};
    constexpr double kDark[3] = {0.65, 0.5, 0.9}, kLift[3] = {0.045, 0, 0}, kSlope[3] = {1.75, 2, 1.97};
    const double t = saturate((x - kLow[c] - kOffset[c]) / (kHigh[c] - kLow[c]));
    return {.dark = t * t * kDark[c] * (c == 2 ? t : 1) + kLift[c],
            .light = saturate((x - 1) * kSlope[c] + 0.99)};
}

double tight_curve(size_t channel, double x) {
    constexpr double kMixLow[3] = {0, 0.35, 0.35}, kMixHigh[3] = {1, 0.7, 0.6};
    const TightPieces pieces = tight_pieces(channel, x);
    const double m = saturate((x - kMixLow[channel]) / (kMixHigh[channel] - kMixLow[channel]));
    return std::lerp(pieces.dark, pieces.light, m * m);
}

double flat_curve(size_t channel, double x) {
    constexpr double kSlope[3] = {1.95, 2, 2}, kTop[3] = {0.99, 0.99, 1};
    return saturate((x - 1) * kSlope[channel] + kTop[channel]);
}

}  // namespace

TightPieces curve_2015_tight_pieces(size_t channel, double n_dot_l) {
    return tight_pieces(channel, n_dot_l * 0.5 + 0.5);
}

Rgb curve_2015_direct(double n_dot_l, double curvature_per_mm) {
    const double x = n_dot_l * 0.5 + 0.5, away = 1 - radius_share(curvature_per_mm);
    Rgb d;
    for (size_t c = 0; c < 3; ++c)
        d[c] = std::lerp(tight_curve(c, x), flat_curve(c, x), 1 - std::pow(away, 4));
    return d;
}

std::array<Rgb, 3> curve_2015_zonal(double curvature_per_mm) {
    const double share = radius_share(curvature_per_mm);
    const auto near = [&](double slope) { return 1 - saturate(share * slope); };
    const double lift = std::pow(near(2.7), 3), away2 = (1 - share) * (1 - share);
    const Rgb rise = {1 / (share * 3.2 + 0.4), std::pow(near(3.0), 4), std::pow(near(2.7), 4)};
    constexpr double kRise[3] = {0.061659, 0.00991683, 0.003783}, kBase[3] = {0.868938, 0.885506, 0.885400};
    constexpr double kLow[3] = {0.7672169, 1.009236, 1.017741}, kHigh[3] = {1.018366, 1.022107, 1.022232};
    constexpr double kLift[3] = {0.197573092, 0.0117447875, 0.0040980375};
    std::array<Rgb, 3> zh;
    for (size_t c = 0; c < 3; ++c) {
        zh[0][c] = rise[c] * kRise[c] + kBase[c];
        zh[1][c] = std::lerp(kHigh[c], kLift[c] * (1 - lift) + kLow[c], away2);
        zh[2][c] = 0.495416;
    }
    return zh;
}

}  // namespace dermis::inline optics
