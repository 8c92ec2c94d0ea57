// Colour, gloss and relief of the skin from a few layers of noise. Zones say how much of each; borders that
// must be sharp (vermilion, brows, lashes) come from the shapes themselves.

#include "dermis/bust/skin.h"

#include <array>

#include "dermis/bust/noise.h"
#include "dermis/bust/parts.h"
#include "dermis/image/colour.h"

namespace dermis::bust {
namespace {

// OpenPBR 1.1, skin examples I to VI, ACEScg.
constexpr std::array<Vec3, 6> kTones = {{{.762f, .652f, .568f},
                                         {.671f, .505f, .371f},
                                         {.545f, .445f, .359f},
                                         {.351f, .240f, .148f},
                                         {.227f, .157f, .091f},
                                         {.073f, .052f, .025f}}};

float mixf(float a, float b, float t) {
    return a + (b - a) * t;
}
Vec3 mixc(Vec3 a, Vec3 b, float t) {
    return a + (b - a) * t;
}
float step(double low, double high, double v) {
    return float(smooth_step(low, high, v));
}

// More or less blood: green and blue absorbed, red hardly. More pigment: all absorbed, blue most.
Vec3 redder(Vec3 c, float amount) {
    return c * Vec3{1 - 0.10f * amount, 1 - 0.50f * amount, 1 - 0.42f * amount};
}
Vec3 darker(Vec3 c, float amount) {
    return c * Vec3{1 - 0.55f * amount, 1 - 0.68f * amount, 1 - 0.76f * amount};
}

struct Lips {
    float vermilion = 0;  // 1 on the red of the lips
    float along = 0;      // 0 at the meeting line, 1 from 5 mm away
    float line = 0;       // 1 where the lips meet
};
Lips lips(Point p) {
    const LipShape s = lip_shape(p.x);
    const double edge = std::min(s.top_y - p.y, p.y - s.bottom_y);
    Lips l;
    const float ragged = 0.5f * value_noise({p.x * 0.55, p.y * 0.3, 9}, 40);
    l.vermilion = step(-1.5, 1.7, edge + ragged) * (1 - step(24.0, 26.2, std::abs(p.x)));
    l.along = float(std::min(std::abs(p.y - s.line_y) / 5.0, 1.0));
    l.line = 1 - step(0.1, 1.1, std::abs(p.y - s.line_y));
    return l;
}

struct Relief {
    float height_mm, pore;
};
Relief relief(Point p, const SkinZones& z, float vermilion, uint32_t seed) {
    // Pores pull the skin down at the cells' centres; fine furrows run between them, drawn out across the
    // lines of least tension: level on the forehead and neck.
    const double level = 0.55 * z.forehead + 0.35 * z.neck + 0.25 * z.eye_ring;
    const Point q = {p.x * (1 - level), p.y * (1 + 0.4 * level), p.z * (1 - 0.5 * level)};
    const float coarse = mixf(0.78f, 1.0f, z.nose);
    const Cells cells = cell_noise(q * (1 / 1.25), seed + 10);
    const float size = 0.16f + 0.16f * cells.random;
    const float amount =
        std::clamp(0.35f + 0.75f * z.nose + 0.45f * z.cheek + 0.3f * z.t_zone - 0.6f * z.lid - 0.2f * z.neck,
                   0.05f, 1.2f);
    const float pore = (1 - std::min(cells.nearest / (size * 1.6f), 1.0f)) * amount * coarse;
    const float furrow = 1 - std::min((cells.second - cells.nearest) * 3.2f, 1.0f);
    const float grain = value_noise(q * 1.9, seed + 11);
    float height = -0.100f * pore - 0.030f * furrow * (0.6f + 0.5f * z.eye_ring) + 0.014f * grain;
    // Fine lines: level on the forehead, round the lids.
    const float lines = value_noise({p.x * 0.05, p.y * 0.62, p.z * 0.05}, seed + 12);
    height += 0.045f * z.forehead * std::min(0.0f, 0.25f - std::abs(lines)) * -1.0f * 0.6f;
    const float crepe = value_noise({p.x * 0.25, p.y * 1.25, p.z * 0.2}, seed + 13);
    height += 0.030f * z.lid * crepe;
    if (vermilion > 0) {
        const float wobble = value_noise({p.x * 0.35, p.y * 0.22, 4}, seed + 14);
        const float folds = value_noise({p.x * 0.95 + 0.8 * wobble, p.y * 0.10, 0}, seed + 15);
        const float small = value_noise({p.x * 2.1 + wobble, p.y * 0.22, 2}, seed + 16);
        height = mixf(height, 0.100f * folds + 0.035f * small, vermilion);
    }
    return {height, pore * (1 - vermilion)};
}

}  // namespace

Vec3 tone_albedo_linear(double tone) {
    const double at = std::clamp(tone, 1.0, 6.0) - 1;
    const int i = std::min(int(at), 4);
    return kLinearFromAcesCg * mixc(kTones[size_t(i)], kTones[size_t(i) + 1], float(at - i));
}

SkinSample skin_at(Point p, const SkinZones& z, const BustParams& params, const Hairs& hairs_drawn) {
    const uint32_t seed = params.seed * 7919u;
    const float broad = value_noise(p * (1 / 14.0), seed + 1), middle = value_noise(p * (1 / 5.0), seed + 2),
                fine = value_noise(p * (1 / 1.8), seed + 3);
    const float depth = float(std::clamp((params.tone - 1) / 5, 0.0, 1.0));  // dark skin hides blood
    const float blood = mixf(1.0f, 0.45f, depth);
    Vec3 c = tone_albedo_linear(params.tone);

    float red = 0.24f + 0.26f * z.cheek + 0.25f * z.nose + 0.36f * z.ear + 0.14f * z.knob +
                0.24f * z.eye_ring + 0.35f * z.nostril;
    red += 0.12f * broad + 0.10f * middle * (0.6f + z.cheek + z.nose) + 0.05f * fine;
    c = redder(c, blood * std::clamp(red, -0.15f, 0.9f));
    c = darker(c, std::max(0.0f, 0.14f * z.lid + 0.17f * z.eye_ring + 0.04f * middle + 0.03f * fine +
                                     0.04f * z.neck));
    // The examples' hues wander: II leans to yellow, where a fair skin is cooler away from the forehead; IV
    // to VI lean to olive.
    const Vec3 warm = {1.01f, 1.0f, 0.98f};
    const float yellow = float(std::clamp(1 - std::abs(params.tone - 2), 0.0, 1.0));
    const Vec3 fair = mixc(Vec3{0.98f, 0.96f, 1.03f}, warm, std::max(depth, 0.6f * z.forehead));
    c = c * mixc(warm, fair, yellow) * mixc({1, 1, 1}, {1.05f, 0.93f, 1.12f}, step(3, 4.5, params.tone));

    // Freckles: nose and cheeks first, each with a size and a strength of its own.
    const float freckled =
        float(params.freckles) * std::clamp(0.25f + z.cheek + 0.8f * z.nose + 0.3f * z.forehead, 0.0f, 1.0f);
    if (freckled > 0) {
        const Cells spots = cell_noise(p * (1 / 3.4) + Point{0.05 * middle, 0.05 * fine, 0}, seed + 4);
        const float radius = 0.10f + 0.22f * spots.random * spots.random;
        const float shown = spots.random * 7.31f - std::floor(spots.random * 7.31f) < freckled ? 1.0f : 0.0f;
        c = darker(c, shown * (0.10f + 0.16f * spots.random) *
                          (1 - step(radius * 0.5f, radius, spots.nearest)) * (1 - 0.7f * depth));
    }

    // Stubble: a cool shade with the roots as dots, on the shaved head as on the chin.
    const float patchy = 0.90f + 0.10f * broad + 0.08f * middle;
    const float shaved = float(params.stubble) * patchy;
    const float cover = std::min(1.0f, shaved * std::max(1.45f * z.beard, 1.6f * z.scalp));
    if (cover > 0) {
        const float hair = 1 - step(0.14, 0.44, cell_noise(p * (1 / 0.75), seed + 5).nearest);
        c = mixc(c,
                 c * mixc(mixc(Vec3{0.54f, 0.53f, 0.52f}, Vec3{0.50f, 0.53f, 0.56f}, yellow),
                          Vec3{0.75f, 0.74f, 0.74f}, depth),
                 0.9f * cover);
        c = darker(c, 0.32f * cover * hair);
    }

    Lips lip;
    if (z.mouth > 0 && p.z > 60) lip = lips(p);
    if (lip.vermilion > 0) {
        Vec3 red_lip =
            redder(tone_albedo_linear(params.tone), mixf(1.05f, 0.5f, depth)) * Vec3{0.80f, 0.69f, 0.78f};
        red_lip = darker(red_lip, 0.10f * depth + 0.16f * (1 - lip.along) + 0.08f * middle + 0.06f * fine);
        c = mixc(c, red_lip, (0.76f + 0.10f * middle) * lip.vermilion);
        c = darker(c, 0.75f * lip.line * lip.vermilion);
    }
    const float hollow = z.nostril > 0 ? 1 - step(0.2, 1.8, nostril_distance_mm(p)) : 0;
    c = c * mixc({1, 1, 1}, {0.16f, 0.09f, 0.08f}, hollow);
    const Relief r = relief(p, z, lip.vermilion, seed);
    c = darker(c, 0.10f * r.pore);
    const float hairs = hairs_drawn.cover(p);
    c = mixc(c, Vec3{0.040f, 0.026f, 0.018f} * mixf(1.0f, 0.35f, depth), 0.9f * hairs);

    SkinSample s;
    s.albedo_linear = c;
    s.height_mm = r.height_mm + 0.06f * hairs;
    s.roughness = 0.47f - 0.09f * z.t_zone - 0.05f * z.nose + 0.03f * z.cheek + 0.06f * z.neck +
                  0.05f * middle + 0.03f * fine + 0.06f * r.pore + 0.06f * cover;
    s.roughness = mixf(s.roughness, 0.38f + 0.05f * fine, lip.vermilion);
    s.specular =
        std::clamp(0.92f + 0.08f * z.t_zone - 0.35f * r.pore + 0.05f * middle - 0.4f * hairs, 0.2f, 1.0f);
    // Nothing of the sky is seen from the nostrils and from between the lips.
    s.specular *= 1 - 0.95f * std::max(hollow, lip.line * lip.vermilion);
    s.kernel_size =
        1 - 0.45f * z.ear - 0.35f * z.nostril - 0.25f * z.lid - 0.15f * lip.vermilion - 0.5f * hairs;
    s.kernel_size = std::clamp(s.kernel_size, 0.25f, 1.0f);
    return s;
}

}  // namespace dermis::bust
