// Regions of the standard head with soft borders: redness, gloss, beard.

#include <array>
#include <span>

#include "subjects/bust/noise.h"
#include "subjects/bust/skin.h"

namespace dermis::bust {
namespace {

// 1 in the middle of an ellipsoid, 0 outside it.
float blob(Point p, Point center, Point radii) {
    const Point q = {(p.x - center.x) / radii.x, (p.y - center.y) / radii.y, (p.z - center.z) / radii.z};
    const double rest = std::max(0.0, 1 - dot(q, q));
    return float(rest * rest * (3 - 2 * rest));
}

float ramp(double low, double high, double v) {
    return float(smooth_step(low, high, v));
}

// Straight lines through (x, y) knots of rising x.
double polyline(std::span<const std::array<double, 2>> knots, double x) {
    size_t i = 0;
    while (i + 2 < knots.size() && x > knots[i + 1][0]) ++i;
    const double t = std::clamp((x - knots[i][0]) / (knots[i + 1][0] - knots[i][0]), 0.0, 1.0);
    return mix(knots[i][1], knots[i + 1][1], t);
}

// How far inside the hairline a point of the left half lies, roughly: over the forehead (receding a little
// above the temples), down the temple to the sideburn, round the ear, down to the nape.
double into_hair_mm(Point q) {
    constexpr std::array<double, 2> kTop[] = {{0, 83}, {16, 84}, {32, 90}, {46, 88}, {58, 74}, {66, 55}};
    constexpr std::array<double, 2> kFront[] = {{-20, 31}, {0, 31},  {20, 33}, {38, 40},
                                                {50, 55},  {62, 58}, {80, 48}};
    constexpr std::array<double, 2> kFoot[] = {{-80, -58}, {-60, -56}, {-44, -47}, {-34, -38},
                                               {-27, -22}, {-22, 8},   {-15, 30},  {-6, 39},
                                               {6, 38},    {13, 22},   {18, -4},   {60, -8}};
    const double above = q.y - polyline(kTop, q.x), behind = polyline(kFront, q.y) - q.z;
    return std::min(std::max(above, behind), q.y - polyline(kFoot, q.z));
}

}  // namespace

SkinZones skin_zones(Point p) {
    const Point q = {std::abs(p.x), p.y, p.z};
    SkinZones z;
    z.cheek = blob(q, {43, -8, 84}, {32, 30, 40});
    z.nose = std::max(blob(p, {0, -10, 124}, {26, 24, 24}), 0.6f * blob(p, {0, 8, 116}, {18, 34, 26}));
    z.t_zone = std::max({blob(p, {0, 68, 95}, {58, 40, 45}), blob(p, {0, 10, 116}, {20, 50, 26}),
                         blob(p, {0, -76, 106}, {26, 20, 24})});
    z.ear = blob(q, {91, 4, -7}, {32, 47, 36});
    z.lid = blob(q, {31, 22, 92}, {22, 14, 22});
    z.eye_ring = blob(q, {30, 18, 92}, {30, 24, 30});
    // Beard: upper lip, chin, jaw and under it; thin on the cheeks and the throat.
    const float low = 1 - ramp(-40, -8, q.y - 0.35 * std::max(0.0, 60 - q.z) + 0.12 * q.x);
    const float lip = blob(p, {0, -25, 110}, {36, 15, 26});
    z.beard = std::max(low, lip) * ramp(2, 26, q.z) * ramp(-122, -92, q.y) *
              (1 - 0.35f * blob(p, {0, -56, 108}, {9, 7, 20}));
    z.scalp =
        ramp(-7, 9,
             into_hair_mm(q) + 4.5 * value_noise(p * (1 / 11.0), 31) + 2.0 * value_noise(p * (1 / 3.5), 32)) *
        (1 - 0.9f * z.ear);
    z.forehead = blob(p, {0, 62, 92}, {70, 36, 50});
    z.neck = 1 - ramp(-112, -86, p.y);
    z.mouth = blob(p, {0, -39, 108}, {48, 30, 40}) > 0 ? 1.0f : 0.0f;
    z.knob = std::max(blob(p, {0, -78, 108}, {22, 18, 22}), blob(q, {30, 46, 98}, {30, 14, 24}));
    z.perioral = std::max(blob(q, {33, -46, 92}, {17, 22, 26}), 0.8f * blob(p, {0, -57, 106}, {24, 12, 22}));
    z.nostril = blob(q, {8, -17, 112}, {12, 8, 14});
    return z;
}

}  // namespace dermis::bust
