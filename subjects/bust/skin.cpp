// Colour, gloss and relief of the skin from a few layers of noise. Zones give the amount of each; sharp
// borders (vermilion, brows, lashes) are those of the shapes themselves. Colour is painted as melanin and
// blood, in texels of pigment maps: equal steps of their square roots are about equal steps of the colour's
// logarithm in fair and dark skin.

#include "subjects/bust/skin.h"

#include "subjects/bust/noise.h"
#include "subjects/bust/parts.h"
#include "subjects/bust/relief.h"

namespace dermis::bust {
namespace {

Vec3 mixc(Vec3 a, Vec3 b, float t) {
    return a + (b - a) * t;
}
float step(double low, double high, double v) {
    return float(smooth_step(low, high, v));
}

struct Lips {
    float vermilion = 0;  // 1 on the red of the lips
    float along = 0;      // 0 at the meeting line, 1 from 5 mm away
    float line = 0;       // 1 where the lips meet
    float upper = 0;
    float rim = 0;  // 1 on the pale roll around the red
};
Lips lips(Point p) {
    const LipShape s = lip_shape(p.x);
    const float ragged = 0.5f * value_noise({p.x * 0.30, p.y * 0.25, 9}, 40) +
                         0.25f * value_noise({p.x * 0.9, p.y * 0.5, 3}, 41);
    const double edge = std::min(s.top_y - p.y, p.y - s.bottom_y) + double(ragged);
    const float within = 1 - step(23.0, 26.2, std::abs(p.x));
    Lips l;
    l.vermilion = step(-1.8, 2.2, edge) * within;
    l.rim = step(-3.6, -2.0, edge) * (1 - step(-1.4, 0.2, edge)) * within;
    l.along = float(std::min(std::abs(p.y - s.line_y) / 5.0, 1.0));
    l.line = 1 - step(0.1, 1.1, std::abs(p.y - s.line_y));
    l.upper = step(-0.4, 0.4, p.y - s.line_y);
    return l;
}

struct Mottle {
    float broad, blotch, middle, fine, grain;  // features of 15, 7, 3.5, 1.5 and 0.6 mm, each -1 to 1
};
Mottle mottle(Point p, uint32_t seed) {
    Mottle m;
    m.broad = value_noise(p * (1 / 15.0), seed + 1);
    // The larger layers displace the smaller ones, which hides the lattice of the noise.
    const Point q = p + Point{1, -1, 1} * (2.5 * double(m.broad));
    m.blotch = value_noise(q * (1 / 7.0), seed + 2);
    m.middle = value_noise((q + Point{1, 1, -1} * double(m.blotch)) * (1 / 3.5), seed + 3);
    m.fine = value_noise(p * (1 / 1.5), seed + 6);
    m.grain = value_noise(p * (1 / 0.6), seed + 7);
    return m;
}

// Freckles: nose and cheeks first, each with a size and a strength of its own; a few are moles.
float freckle(Point p, const SkinZones& z, const Mottle& m, float density, uint32_t seed) {
    const float wanted = density * std::clamp(0.2f + z.cheek + 0.8f * z.nose + 0.3f * z.forehead, 0.0f, 1.0f);
    if (wanted <= 0) return 0;
    const Cells spots =
        cell_noise(p * (1 / 3.4) + Point{0.08 * double(m.middle), 0.08 * double(m.fine), 0}, seed + 4);
    const auto digit = [&](float f) { return spots.random * f - std::floor(spots.random * f); };
    if (digit(7.31f) >= wanted) return 0;
    const bool mole = digit(53.7f) < 0.02f;
    const float radius = mole ? 0.22f + 0.12f * digit(3.3f) : 0.10f + 0.22f * spots.random * spots.random;
    const float strength = mole ? 0.29f : 0.05f + 0.10f * spots.random;
    return strength * (1 - step(radius * 0.5f, radius, spots.nearest));
}

struct Stubble {
    float shade = 0, hair = 0;  // shade: of the roots under the skin; hair: 1 on a cut end
};
Stubble stubble(Point p, const SkinZones& z, const Mottle& m, float amount, uint32_t seed) {
    const float patchy = 1 + 0.12f * m.broad + 0.14f * m.blotch + 0.10f * m.middle;
    const float cover = std::min(1.0f, amount * patchy * std::max(1.5f * z.beard, 1.6f * z.scalp));
    if (cover <= 0) return {};
    // Cut ends are oblique and lie along the growth, mostly downwards; each has a fixed place, and there are
    // fewer where the cover is less.
    const double spacing = z.scalp > z.beard ? 0.86 : 1.0;
    const Cells ends = cell_noise(Point{p.x, 0.72 * p.y, p.z} * (1 / spacing), seed + 5);
    Stubble s;
    s.shade = cover;
    if (ends.random < 0.25f + 0.75f * cover)
        s.hair = (1 - step(0.10, 0.34, ends.nearest)) * (0.55f + 0.45f * ends.random) * std::sqrt(cover);
    return s;
}

// What the zones and the noise add to the texels of the pigment maps.
PigmentTexel details(const SkinZones& z, const Mottle& m, float depth) {
    const float blood = 0.12f * z.cheek + 0.155f * z.nose + 0.15f * z.ear + 0.06f * z.knob +
                        0.06f * z.eye_ring + 0.07f * z.lid + 0.17f * z.nostril - 0.01f * z.perioral +
                        0.02f * z.forehead - 0.01f * z.neck +
                        (0.024f * m.broad + 0.034f * m.blotch + 0.024f * m.middle) *
                            (0.6f + z.cheek + 0.8f * z.nose + 0.4f * z.neck) +
                        0.02f * m.fine + 0.01f * m.grain;
    const float melanin = 0.022f * z.lid + 0.036f * z.eye_ring + 0.018f * z.neck + 0.018f * m.broad -
                          0.014f * m.blotch + 0.022f * m.middle + 0.027f * m.fine + 0.022f * m.grain +
                          depth * (0.055f * z.perioral + 0.030f * z.forehead - 0.043f * z.cheek);
    return {melanin, blood * (1 - 0.3f * depth)};
}

PigmentTexel lip_pigments(PigmentTexel tone, const Lips& l, const Mottle& m, float depth) {
    // Fair lips are thin skin over blood. Dark ones keep their melanin, most on the upper lip, and lose it
    // towards the moist inside of the lower.
    const float inside = (1 - l.along) * (1 - l.upper);
    const float blood = mixf(0.40f + 0.08f * l.upper + 0.07f * (1 - l.along), 0.24f, depth) +
                        0.055f * m.middle + 0.03f * m.fine;
    const float melanin = mixf(0.02f + 0.06f * l.upper, 0.03f + 0.10f * l.upper - 0.115f * inside, depth) +
                          0.03f * m.blotch + 0.02f * m.fine;
    return {tone.melanin + melanin, tone.blood + blood};
}

constexpr Vec3 kInNostril = {0.30f, 0.16f, 0.13f};  // share of the light that is left
constexpr Vec3 kBetweenLips = {0.52f, 0.29f, 0.17f};
constexpr Vec3 kHairAlbedoLinear = {0.036f, 0.022f, 0.015f};

// Stubble: roots below the skin, and cut ends.
Vec3 stubble_factor(const Stubble& shaved, float scalp, float strength) {
    return mixc({1, 1, 1}, {0.63f, 0.63f, 0.68f}, (0.6f + 0.4f * scalp) * strength * shaved.shade) *
           mixc({1, 1, 1}, {0.34f, 0.33f, 0.34f}, 0.85f * strength * shaved.hair);
}

}  // namespace

PigmentTexel pigments_of_tone(double tone) {
    const int first = std::clamp(int(tone), 1, 5);
    const auto at = [](int group) {
        const SkinModel model = skin_model_of_tone(group);
        return PigmentTexel{float(pigment_texel(model.melanin, kMostMelanin)),
                            float(pigment_texel(model.blood, kMostBlood))};
    };
    const PigmentTexel low = at(first), high = at(first + 1);
    const auto t = float(std::clamp(tone, 1.0, 6.0) - first);
    return {mixf(low.melanin, high.melanin, t), mixf(low.blood, high.blood, t)};
}

Vec3 bare_albedo_linear(const SkinSample& sample, const PigmentTable& table) {
    const Rgb skin = table.albedo_of_texels(double(sample.pigments.melanin), double(sample.pigments.blood));
    return to_vec3(skin) * sample.residue;
}

SkinSample skin_at(Point p, const SkinZones& z, const BustParams& params, const Hairs& hairs_drawn) {
    const uint32_t seed = params.seed * 7919u;
    const float depth = float(std::clamp((params.tone - 1) / 5, 0.0, 1.0));
    const float brown = std::max(0.0f, depth - 0.2f);  // above the fair tones
    const Mottle m = mottle(p, seed);
    Lips lip;
    if (z.mouth > 0 && p.z > 60) lip = lips(p);
    const Relief r = relief_at(p, z, lip.vermilion, seed);

    const PigmentTexel tone = pigments_of_tone(params.tone);
    PigmentTexel pigment = details(z, m, depth);
    pigment.melanin += tone.melanin + (1 - 0.5f * depth) * freckle(p, z, m, float(params.freckles), seed);
    pigment.melanin += (0.08f - 0.03f * depth) * r.pore + 0.045f * r.cavity - 0.014f * lip.rim;
    pigment.blood += tone.blood + 0.045f * r.pore + 0.065f * r.cavity - 0.02f * lip.rim;

    SkinSample s;
    const Stubble shaved = stubble(p, z, m, float(params.stubble), seed);
    s.residue = stubble_factor(shaved, z.scalp, (1 - 0.45f * depth) * (1 - lip.vermilion));
    if (lip.vermilion > 0) {
        const PigmentTexel red = lip_pigments(tone, lip, m, std::min(1.0f, depth + 0.6f * brown));
        const float red_share = 0.92f * lip.vermilion;
        pigment = {mixf(pigment.melanin, red.melanin, red_share), mixf(pigment.blood, red.blood, red_share)};
        s.residue = s.residue * mixc({1, 1, 1}, kBetweenLips, lip.line * lip.vermilion);
    }
    s.pigments = {std::clamp(pigment.melanin, 0.0f, 1.0f), std::clamp(pigment.blood, 0.0f, 1.0f)};
    const float hollow = z.nostril > 0 ? 1 - step(0.0, 2.2, nostril_distance_mm(p)) : 0;
    const float hairs = hairs_drawn.cover(p), hair_share = 0.92f * hairs;
    const Vec3 shadow = mixc({1, 1, 1}, kInNostril, hollow);
    s.residue = s.residue * shadow * (1 - hair_share);
    s.hair_linear = kHairAlbedoLinear * (mixf(1.0f, 0.35f, depth) * hair_share);
    s.height_mm = r.height_mm + 0.07f * hairs + 0.05f * shaved.hair;
    s.roughness = 0.48f - 0.08f * z.t_zone - 0.05f * z.nose + 0.03f * z.cheek + 0.05f * z.neck -
                  0.02f * depth + 0.06f * brown + 0.05f * m.blotch + 0.04f * m.middle + 0.05f * m.fine +
                  0.12f * r.pore + 0.05f * shaved.shade + 0.10f * shaved.hair;
    s.roughness = mixf(s.roughness, 0.42f + 0.06f * m.fine + 0.05f * m.middle, lip.vermilion);
    s.specular = std::clamp(
        0.92f + 0.08f * z.t_zone - 0.45f * r.pore - 0.2f * r.cavity + 0.06f * m.middle - 0.4f * hairs, 0.2f,
        1.0f);
    // The nostrils and the line between the lips see nothing of the environment.
    s.specular *= 1 - 0.95f * std::max(hollow, lip.line * lip.vermilion);
    s.kernel_size = std::clamp(0.6f * z.ear + 0.45f * z.nostril + 0.3f * z.lid, 0.0f, 1.0f) * (1 - hairs);
    return s;
}

}  // namespace dermis::bust
