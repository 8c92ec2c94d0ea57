#include "dermis/scene/brdf_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/image/half.h"
#include "dermis/scene/hammersley.h"

namespace dermis::inline scene {

namespace {

// A half vector with the density of the GGX normals visible from `v` (Heitz 2018, "Sampling the GGX
// Distribution of Visible Normals", section 3): stretch to a hemisphere, sample its disk as seen from v,
// stretch back.
Vec3 sample_visible_half_vector(Vec2 xi, Vec3 v, float alpha) {
    const Vec3 vh = normalize(Vec3{alpha * v.x, alpha * v.y, v.z});
    const float across2 = vh.x * vh.x + vh.y * vh.y;
    const Vec3 t1 = across2 > 0 ? Vec3{-vh.y, vh.x, 0} * (1 / std::sqrt(across2)) : Vec3{1, 0, 0};
    const Vec3 t2 = cross(vh, t1);
    const float r = std::sqrt(xi.x), phi = 2 * std::numbers::pi_v<float> * xi.y;
    const float a = r * std::cos(phi), s = 0.5f * (1 + vh.z);
    const float b = (1 - s) * std::sqrt(1 - a * a) + s * r * std::sin(phi);
    const Vec3 nh = t1 * a + t2 * b + vh * std::sqrt(std::max(0.0f, 1 - a * a - b * b));
    return normalize(Vec3{alpha * nh.x, alpha * nh.y, std::max(0.0f, nh.z)});
}

// Smith's Lambda (Heitz 2014, equation 72) of a direction with cosine c.
float smith_lambda(float c, float a2) {
    return 0.5f * (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1);
}

}  // namespace

// The estimator over visible normals is F G2 / G1, which never exceeds 1.
Vec2 ggx_scale_and_bias(float roughness, float n_dot_v, int samples) {
    const float alpha = std::max(roughness * roughness, 1e-4f), a2 = alpha * alpha;
    const float nv = std::clamp(n_dot_v, 1e-4f, 1.0f);
    const Vec3 v = {std::sqrt(1 - nv * nv), 0, nv};
    const float lambda_v = smith_lambda(nv, a2);
    double scale = 0, bias = 0;
    for (int i = 0; i < samples; ++i) {
        const Vec3 h = sample_visible_half_vector(hammersley(uint32_t(i), uint32_t(samples)), v, alpha);
        const float vh = std::clamp(dot(v, h), 0.0f, 1.0f);
        const float nl = 2 * vh * h.z - nv;
        if (nl <= 0) continue;
        const float weight = (1 + lambda_v) / (1 + lambda_v + smith_lambda(nl, a2));
        const float m = 1 - vh, fresnel = m * m * m * m * m;
        scale += double(weight * (1 - fresnel));
        bias += double(weight * fresnel);
    }
    return {float(scale / samples), float(bias / samples)};
}

// Half vectors with the density D cos: f_r n.l over that of the light's direction, D cos / (4 h.v), is
// n.l / (h.v n.h).
Vec2 ksk_scale_and_bias(float roughness, float n_dot_v, int samples) {
    const float alpha = std::max(roughness * roughness, 1e-4f);
    const float nv = std::clamp(n_dot_v, 1e-4f, 1.0f), sv = std::sqrt(1 - nv * nv);
    double scale = 0, bias = 0;
    for (int i = 0; i < samples; ++i) {
        const Vec2 xi = hammersley(uint32_t(i), uint32_t(samples));
        const float tangent2 = -alpha * alpha * std::log(1 - xi.x), nh = 1 / std::sqrt(1 + tangent2);
        const float phi = 2 * std::numbers::pi_v<float> * xi.y;
        const float vh = nh * (sv * std::sqrt(tangent2) * std::cos(phi) + nv);
        const float nl = 2 * vh * nh - nv;
        if (nl <= 0 || vh <= 0) continue;
        const float weight = nl / (vh * nh);
        const float m = 1 - std::min(vh, 1.0f), fresnel = m * m * m * m * m;
        scale += double(weight * (1 - fresnel));
        bias += double(weight * fresnel);
    }
    return {float(scale / samples), float(bias / samples)};
}

namespace {

using Texel = std::array<uint16_t, 4>;

size_t table_bytes(int size) {
    return size_t(size) * size_t(size) * kBrdfLobes * sizeof(Texel);
}

void fill_row(std::span<Texel> row, int lobe, float roughness) {
    Vec2 mean;
    std::vector<Vec2> values(row.size());
    for (size_t x = 0; x < row.size(); ++x) {
        const float cosine = (float(x) + 0.5f) / float(row.size());
        values[x] = lobe == kBrdfLobeKsk ? ksk_scale_and_bias(roughness, cosine)
                                         : ggx_scale_and_bias(roughness, cosine);
        mean = mean + values[x] * (2 * cosine / float(row.size()));
    }
    for (size_t x = 0; x < row.size(); ++x)
        row[x] = {to_half(values[x].x), to_half(values[x].y), to_half(mean.x), to_half(mean.y)};
}

}  // namespace

std::vector<std::byte> make_brdf_table(int size) {
    const auto side = size_t(size);
    std::vector<Texel> texels(side * side * kBrdfLobes);
    parallel_for(side * kBrdfLobes, 1, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row)
            fill_row(std::span(texels).subspan(row * side, side), int(row / side),
                     (float(row % side) + 0.5f) / float(size));
    });
    const auto bytes = std::as_bytes(std::span(texels));
    return {bytes.begin(), bytes.end()};
}

Result<std::vector<std::byte>> stored_brdf_table() {
    // Raise with every change to what the table holds.
    constexpr int kVersion = 3;
    return cached("brdf", Hasher().add(kVersion).add(kBrdfTableSize).hex(),
                  std::vector<std::byte>(table_bytes(kBrdfTableSize)),
                  [] { return Result(make_brdf_table(kBrdfTableSize)); });
}

Result<BrdfTable> BrdfTable::load() {
    DERMIS_TRY_ASSIGN(std::vector<std::byte> texels, stored_brdf_table());
    BrdfTable table;
    table.texels_ = std::move(texels);
    return table;
}

Vec4 BrdfTable::at(int lobe, float roughness, float cosine) const {
    constexpr int kLast = kBrdfTableSize - 1;
    const auto texel = [&](int x, int y) -> Vec4 {
        const int row = lobe * kBrdfTableSize + std::clamp(y, 0, kLast);
        Texel half;
        std::memcpy(&half, &texels_[size_t(row * kBrdfTableSize + std::clamp(x, 0, kLast)) * sizeof half],
                    sizeof half);
        return {from_half(half[0]), from_half(half[1]), from_half(half[2]), from_half(half[3])};
    };
    const auto lerp = [](Vec4 a, Vec4 b, float t) -> Vec4 {
        return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t), std::lerp(a.z, b.z, t),
                std::lerp(a.w, b.w, t)};
    };
    const float x = cosine * kBrdfTableSize - 0.5f, y = roughness * kBrdfTableSize - 0.5f;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const float fx = x - float(x0);
    return lerp(lerp(texel(x0, y0), texel(x0 + 1, y0), fx),
                lerp(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fx), y - float(y0));
}

}  // namespace dermis::inline scene
