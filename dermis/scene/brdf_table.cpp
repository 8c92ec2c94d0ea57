#include "dermis/scene/brdf_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/image/half.h"
#include "dermis/scene/hammersley.h"

namespace dermis {

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

size_t table_bytes(int size) {
    return size_t(size) * size_t(size) * 2 * sizeof(uint16_t);
}

std::vector<std::byte> make_brdf_table(int size) {
    std::vector<std::byte> table(table_bytes(size));
    parallel_for(size_t(size), 1, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row)
            for (size_t x = 0; x < size_t(size); ++x) {
                const Vec2 value =
                    ggx_scale_and_bias((float(row) + 0.5f) / float(size), (float(x) + 0.5f) / float(size));
                const uint16_t texel[2] = {to_half(value.x), to_half(value.y)};
                std::memcpy(&table[(row * size_t(size) + x) * sizeof texel], texel, sizeof texel);
            }
    });
    return table;
}

Result<std::vector<std::byte>> stored_brdf_table() {
    // Raise with every change to what the table holds.
    constexpr int kVersion = 1;
    return cached("brdf", Hasher().add(kVersion).add(kBrdfTableSize).hex(), table_bytes(kBrdfTableSize),
                  []() -> Result<std::vector<std::byte>> { return make_brdf_table(kBrdfTableSize); });
}

}  // namespace dermis
