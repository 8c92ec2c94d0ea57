// Every texel is the skin evaluated at its point of the surface; the normal map is the relief's slope.

#include "subjects/bust/maps.h"

#include <cstring>

#include "dermis/base/parallel.h"
#include "dermis/base/progress.h"
#include "dermis/image/colour.h"
#include "subjects/bust/skin.h"

namespace dermis::bust {
namespace {

constexpr int kBand = 32;  // rows of one task; no other task writes them

struct Barycentric {
    double a, b, c;
};

// Barycentric coordinates in the triangle of a texel's middle, also outside the triangle.
Barycentric locate(const Atlas& atlas, int triangle, double u, double v) {
    const auto& t = atlas.mesh.triangles[size_t(triangle)];
    const Point p = atlas.uvs[t[0]], e = atlas.uvs[t[1]] - p, f = atlas.uvs[t[2]] - p, q = Point{u, v, 0} - p;
    const double area = e.x * f.y - e.y * f.x;
    const double inverse = std::abs(area) > 1e-18 ? 1 / area : 0;
    const double b = (q.x * f.y - q.y * f.x) * inverse, c = (e.x * q.y - e.y * q.x) * inverse;
    return {1 - b - c, b, c};
}

void fill_band(const Atlas& atlas, int side, int first_row, std::vector<int>& owner) {
    const int last_row = std::min(first_row + kBand, side) - 1;
    for (size_t i = 0; i < atlas.mesh.triangles.size(); ++i) {
        const auto& t = atlas.mesh.triangles[i];
        const Point a = atlas.uvs[t[0]] * side, b = atlas.uvs[t[1]] * side, c = atlas.uvs[t[2]] * side;
        const int y0 = std::max(first_row, int(std::ceil(std::min({a.y, b.y, c.y}) - 0.5)));
        const int y1 = std::min(last_row, int(std::floor(std::max({a.y, b.y, c.y}) - 0.5)));
        if (y0 > y1) continue;
        const int x0 = std::max(0, int(std::ceil(std::min({a.x, b.x, c.x}) - 0.5)));
        const int x1 = std::min(side - 1, int(std::floor(std::max({a.x, b.x, c.x}) - 0.5)));
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const Barycentric w = locate(atlas, int(i), (x + 0.5) / side, (y + 0.5) / side);
                if (w.a >= -1e-9 && w.b >= -1e-9 && w.c >= -1e-9) owner[size_t(y) * side + x] = int(i);
            }
    }
}

void grow(std::vector<int>& owner, int side) {
    const std::vector<int> before = owner;
    parallel_for(size_t(side), 64, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < side; ++x) {
                int& mine = owner[y * side + x];
                if (mine >= 0) continue;
                const size_t at = y * side + x;
                if (x > 0 && before[at - 1] >= 0)
                    mine = before[at - 1];
                else if (x + 1 < side && before[at + 1] >= 0)
                    mine = before[at + 1];
                else if (y > 0 && before[at - side] >= 0)
                    mine = before[at - side];
                else if (y + 1 < size_t(side) && before[at + side] >= 0)
                    mine = before[at + side];
            }
    });
}

std::vector<SkinZones> zones_by_vertex(const std::vector<Point>& standard) {
    std::vector<SkinZones> zones(standard.size());
    parallel_for(standard.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) zones[i] = skin_zones(standard[i]);
    });
    return zones;
}

SkinZones blend(const SkinZones& a, const SkinZones& b, const SkinZones& c, const Barycentric& w) {
    float in[3][kZoneCount], out[kZoneCount];
    std::memcpy(in[0], &a, sizeof a);
    std::memcpy(in[1], &b, sizeof b);
    std::memcpy(in[2], &c, sizeof c);
    for (int k = 0; k < kZoneCount; ++k)
        out[k] =
            std::clamp(float(w.a) * in[0][k] + float(w.b) * in[1][k] + float(w.c) * in[2][k], 0.0f, 1.0f);
    SkinZones zones;
    std::memcpy(&zones, out, sizeof zones);
    return zones;
}

const PigmentTable& usual_table() {
    static const PigmentTable table{SkinModel{}};
    return table;
}

// The factor of bare skin that makes the mean over the surface without stubble the tone. It holds what the
// model's skin of these pigments lacks of the tone, and what zones and noise have on average.
Vec3 colour_balance(const Atlas& atlas, const std::vector<Point>& standard,
                    const std::vector<SkinZones>& zones, BustParams params, const Hairs& hairs) {
    params.stubble = 0;
    std::vector<Vec3> bare(standard.size()), hair(standard.size());
    parallel_for(standard.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const SkinSample sample = skin_at(standard[i], zones[i], params, hairs);
            bare[i] = bare_albedo_linear(sample, usual_table()), hair[i] = sample.hair_linear;
        }
    });
    Vec3 sum, of_hair;
    float area = 0;
    for (const auto& t : atlas.mesh.triangles) {
        const Point a = atlas.mesh.points[t[0]];
        const float twice = float(length(cross(atlas.mesh.points[t[1]] - a, atlas.mesh.points[t[2]] - a)));
        for (const int corner : t)
            sum += bare[size_t(corner)] * twice, of_hair += hair[size_t(corner)] * twice;
        area += 3 * twice;
    }
    const Vec3 tone = skin_tone_albedo_linear(params.tone) * area - of_hair;
    return {tone.x / sum.x, tone.y / sum.y, tone.z / sum.z};
}

uint8_t code(float v) {
    return uint8_t(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

// Slope of the relief along the tangent (+u) and up the image, for the texel's triangle.
Point relief_normal(const Atlas& atlas, int triangle, double by_u, double by_v) {
    const auto& t = atlas.mesh.triangles[size_t(triangle)];
    const Point e = atlas.mesh.points[t[1]] - atlas.mesh.points[t[0]],
                f = atlas.mesh.points[t[2]] - atlas.mesh.points[t[0]];
    const Point a = atlas.uvs[t[1]] - atlas.uvs[t[0]], b = atlas.uvs[t[2]] - atlas.uvs[t[0]];
    const double area = a.x * b.y - a.y * b.x;
    if (std::abs(area) < 1e-14) return {0, 0, 1};
    const Point along_u = (e * b.y - f * a.y) * (1 / area),
                along_v = (f * a.x - e * b.x) * (1 / area);  // mm per unit
    const double length_u = length(along_u);
    if (length_u < 1e-9) return {0, 0, 1};
    const Point tangent = along_u * (1 / length_u);
    const double shear = dot(along_v, tangent);
    const double across = length(along_v - tangent * shear);
    if (across < 1e-9) return {0, 0, 1};
    const double slope_t = by_u / length_u, slope_up = -(by_v - shear * slope_t) / across;
    return unit({-slope_t, -slope_up, 1});
}

Image normals_of(const Atlas& atlas, const std::vector<int>& owner, const std::vector<float>& height,
                 int side) {
    Image map(side, side, 3, PixelFormat::u8);
    const auto normal = map.values<uint8_t>();
    parallel_for(size_t(side), 8, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < side; ++x) {
                const size_t i = y * side + x;
                Point n = {0, 0, 1};
                if (owner[i] >= 0) {
                    const auto at = [&](int dx, int dy) {
                        const int px = std::clamp(x + dx, 0, side - 1),
                                  py = std::clamp(int(y) + dy, 0, side - 1);
                        const size_t k = size_t(py) * side + px;
                        return owner[k] >= 0 ? height[k] : height[i];
                    };
                    n = relief_normal(atlas, owner[i], 0.5 * side * (at(1, 0) - at(-1, 0)),
                                      0.5 * side * (at(0, 1) - at(0, -1)));
                }
                normal[3 * i] = code(float(0.5 + 0.5 * n.x)),
                           normal[3 * i + 1] = code(float(0.5 + 0.5 * n.y)),
                           normal[3 * i + 2] = code(float(0.5 + 0.5 * n.z));
            }
    });
    return map;
}

SkinMaps blank_maps(int side) {
    const auto grey = [side] { return Image(side, side, 1, PixelFormat::u8); };
    return {.albedo = Image(side, side, 3, PixelFormat::u8, Encoding::srgb),
            .normal = {},
            .roughness = grey(),
            .specular = grey(),
            .kernel_size = grey(),
            .melanin = grey(),
            .blood = grey()};
}

void put(const SkinSample& s, Vec3 albedo_linear, size_t i, SkinMaps& maps) {
    const Vec3 c = srgb_encode(albedo_linear);
    const auto albedo = maps.albedo.values<uint8_t>();
    albedo[3 * i] = code(c.x), albedo[3 * i + 1] = code(c.y), albedo[3 * i + 2] = code(c.z);
    maps.roughness.values<uint8_t>()[i] = code(s.roughness);
    maps.specular.values<uint8_t>()[i] = code(s.specular);
    maps.kernel_size.values<uint8_t>()[i] = code(s.kernel_size);
    maps.melanin.values<uint8_t>()[i] = code(s.pigments.melanin);
    maps.blood.values<uint8_t>()[i] = code(s.pigments.blood);
}

}  // namespace

std::vector<int> rasterize(const Atlas& atlas, int side, int gutter) {
    std::vector<int> owner(size_t(side) * side, -1);
    const size_t bands = size_t(side + kBand - 1) / kBand;
    parallel_for(bands, 1, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) fill_band(atlas, side, int(k) * kBand, owner);
    });
    for (int i = 0; i < gutter; ++i) grow(owner, side);
    return owner;
}

SkinMaps paint_maps(const Atlas& atlas, const BustField& field, const BustParams& params, int side) {
    std::vector<Point> standard(atlas.mesh.points.size());
    for (size_t i = 0; i < standard.size(); ++i) standard[i] = field.to_standard(atlas.mesh.points[i]);
    const std::vector<SkinZones> zones = zones_by_vertex(standard);
    const std::vector<int> owner = rasterize(atlas, side, kGutter * side / kAtlasSide + 1);

    SkinMaps maps = blank_maps(side);
    std::vector<float> height(owner.size(), 0);
    const Hairs hairs(uint32_t(params.seed));
    const SkinSample plain = {.pigments = pigments_of_tone(params.tone)};
    const Vec3 plain_linear = skin_tone_albedo_linear(params.tone);
    const Vec3 balance = colour_balance(atlas, standard, zones, params, hairs);
    Progress progress("painting the skin", size_t(side));
    parallel_for(size_t(side), 8, [&](size_t begin, size_t end) {
        for (size_t i = begin * side; i < end * side; ++i) {
            if (owner[i] < 0) {
                put(plain, plain_linear, i, maps);
                continue;
            }
            const auto& t = atlas.mesh.triangles[size_t(owner[i])];
            const Barycentric w =
                locate(atlas, owner[i], (double(i % side) + 0.5) / side, (double(i / side) + 0.5) / side);
            const Point p = standard[t[0]] * w.a + standard[t[1]] * w.b + standard[t[2]] * w.c;
            const SkinSample s = skin_at(p, blend(zones[t[0]], zones[t[1]], zones[t[2]], w), params, hairs);
            put(s, bare_albedo_linear(s, usual_table()) * balance + s.hair_linear, i, maps);
            height[i] = s.height_mm;
        }
        progress.advance(end - begin);
    });
    maps.normal = normals_of(atlas, owner, height, side);
    return maps;
}

}  // namespace dermis::bust
