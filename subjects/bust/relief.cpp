// Pores sit at the middles of cells and furrows between the cells; over them lies a coarser relief, which
// breaks a highlight into pieces. Lines of expression follow the face.

#include "subjects/bust/relief.h"

#include <array>

#include "subjects/bust/noise.h"
#include "subjects/bust/parts.h"

namespace dermis::bust {
namespace {

// A furrow's cross-section: 1 on its line, 0 from `width` away.
float groove(double away, double width) {
    const double rest = std::max(0.0, 1 - away * away / (width * width));
    return float(rest * rest);
}

// Three lines across the forehead, interrupted and not straight.
float forehead_lines(Point p, uint32_t seed) {
    constexpr std::array<double, 3> kHeights = {58, 69, 80};
    float sum = 0;
    for (size_t i = 0; i < kHeights.size(); ++i) {
        const double wander = 1.6 * value_noise({p.x / 17, 3.0 * double(i), 0}, seed + 21);
        const double dip = 3.0 * std::exp(-p.x * p.x / 500);
        const float there = 0.5f + 0.5f * value_noise({p.x / 23, 5.0 * double(i), 7}, seed + 22);
        sum += groove(p.y - (kHeights[i] + wander - dip - p.x * p.x / 420), 1.5) * there;
    }
    return sum;
}

// Fans of lines at the outer corners of the eyes.
float crows_feet(Point q, uint32_t seed) {
    const double dx = q.x - 46, dy = q.y - 19, r = std::hypot(dx, dy);
    if (dx < 0 || r < 4 || r > 19) return 0;
    const double angle = std::atan2(dy, dx) + 0.06 * double(value_noise({r / 5, 1, 2}, seed + 23));
    if (std::abs(angle) > 0.9) return 0;
    const double ray = angle / 0.36, away = std::abs(ray - std::round(ray)) * 0.36 * r;
    return groove(away, 0.9) * float(smooth_step(4, 7, r) * (1 - smooth_step(11, 19, r)));
}

// Two creases under the lower lid.
float under_eye(Point q) {
    const double x = (q.x - 31) / 17;
    if (std::abs(x) > 1) return 0;
    const double arc = 11.2 + 5.5 * x * x - 1.2 * x;
    return (0.8f * groove(q.y - arc, 0.8) + 0.6f * groove(q.y - arc + 3.4, 1.0)) *
           float(1 - smooth_step(0.55, 1.0, std::abs(x)));
}

// Lines around the neck, deeper at its sides and back.
float neck_rings(Point p, uint32_t seed) {
    float sum = 0;
    const bool front = p.z > 0;
    const double fade = smooth_step(4, 22, front ? p.z : -30 - p.z);
    for (int i = 0; i < 2; ++i) {
        const double level = (front ? -121 - 18.0 * i : -54 - 13.0 * i - 0.004 * p.x * p.x);
        const double wander = 4.0 * double(value_noise({p.x / 24, 4.0 * i, p.z / 40}, seed + 24));
        const double there = smooth_step(-0.5, 0.5, double(value_noise({p.x / 19, 9.0 * i, 3}, seed + 25)));
        sum += groove(p.y - level - wander, front ? 2.2 : 2.6) * float(there * fade);
    }
    return sum;
}

float lip_folds(Point p, uint32_t seed) {
    const float wobble = value_noise({p.x * 0.35, p.y * 0.22, 4}, seed + 14);
    const float wide = value_noise({p.x * 0.62 + 0.7 * double(wobble), p.y * 0.08, 0}, seed + 15),
                fine = value_noise({p.x * 1.7 + double(wobble), p.y * 0.16, 2}, seed + 16);
    // The folds between the swellings are narrow: the noise's zero crossings, turned down.
    return 0.10f * wide - 0.10f * (1 - std::min(1.0f, 4 * std::abs(wide))) + 0.05f * fine;
}

}  // namespace

Relief relief_at(Point p, const SkinZones& z, float vermilion, uint32_t seed) {
    const Point q = {std::abs(p.x), p.y, p.z};
    // Cells are stretched along the lines of least tension: horizontal on the forehead and neck.
    const double level =
        std::min(0.6, 0.5 * double(z.forehead) + 0.4 * double(z.neck) + 0.3 * double(z.eye_ring));
    const Point drawn = {p.x * (1 - level), p.y * (1 + 0.4 * level), p.z * (1 - 0.5 * level)};
    const Cells cells = cell_noise(drawn * (1 / 1.3), seed + 10);
    const float amount =
        std::clamp(0.5f + 0.7f * z.nose + 0.5f * z.cheek + 0.25f * z.t_zone - 0.7f * z.lid - 0.4f * z.neck,
                   0.04f, 1.25f);
    const float pore = amount * (1 - std::min(cells.nearest / (0.34f + 0.22f * cells.random), 1.0f));
    const float furrow = 1 - std::min((cells.second - cells.nearest) * 3.0f, 1.0f);
    const float uneven = value_noise(p * (1 / 2.3), seed + 11), swell = value_noise(p * (1 / 5.0), seed + 17),
                grain = value_noise(drawn * 1.5, seed + 18);

    float folds = 0;
    if (z.forehead > 0) folds += 0.8f * z.forehead * forehead_lines(p, seed);
    if (z.eye_ring > 0) folds += 0.8f * under_eye(q);
    if (q.x > 44 && q.z > 40 && std::abs(q.y - 19) < 20) folds += 0.7f * crows_feet(q, seed);
    if (z.neck > 0 || (p.z < -20 && p.y < -40)) folds += 0.55f * neck_rings(p, seed);

    Relief r;
    r.pore = pore * (1 - vermilion);
    r.cavity = std::min(1.0f, 0.35f * furrow + 0.8f * folds) * (1 - vermilion);
    float height = -0.16f * pore - 0.055f * furrow * (0.6f + 0.5f * z.eye_ring) + 0.055f * grain +
                   (0.055f * uneven + 0.06f * swell) * (1 - 0.5f * z.lid) - 0.22f * folds;
    if (z.lid > 0) height += 0.055f * z.lid * value_noise({p.x * 0.25, p.y * 1.1, p.z * 0.2}, seed + 13);
    if (vermilion > 0) height = mixf(height, 1.2f * lip_folds(p, seed), vermilion);
    r.height_mm = height;
    return r;
}

}  // namespace dermis::bust
