#include "dermis/rays/sampling.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/angle.h"

namespace dermis::inline rays {
namespace {

Vec3 from_cosine(float cosine, float azimuth_rad) {
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    return {sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), cosine};
}

}  // namespace

LocalFrame frame_of(Vec3 normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1 / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    return {{1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
            {b, sign + normal.y * normal.y * a, -normal.y},
            normal};
}

Vec2 sample_disk(Vec2 u) {
    const float x = 2 * u.x - 1, y = 2 * u.y - 1;
    if (x == 0 && y == 0) return {};
    const bool wide = std::abs(x) > std::abs(y);
    const float radius = wide ? x : y;
    const float angle = wide ? kPi / 4 * (y / x) : kPi / 2 - kPi / 4 * (x / y);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

Vec3 sample_cosine_hemisphere(Vec2 u) {
    const Vec2 p = sample_disk(u);
    return {p.x, p.y, std::sqrt(std::max(0.0f, 1 - dot(p, p)))};
}

Vec3 sample_sphere(Vec2 u) {
    return from_cosine(1 - 2 * u.x, 2 * kPi * u.y);
}

float sample_henyey_greenstein_cosine(float u, float g) {
    if (std::abs(g) < 1e-3f) return 1 - 2 * u;
    const float root = (1 - g * g) / (1 + g - 2 * g * u);
    return std::clamp((1 + g * g - root * root) / (2 * g), -1.0f, 1.0f);
}

float henyey_greenstein(float cosine, float g) {
    const float base = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * kPi * base * std::sqrt(base));
}

Vec3 sample_henyey_greenstein(Vec2 u, Vec3 direction, float g) {
    const Vec3 local = from_cosine(sample_henyey_greenstein_cosine(u.x, g), 2 * kPi * u.y);
    return normalize(frame_of(direction).to_world(local));
}

float sample_exponential_mm(float u, float sigma_per_mm) {
    return -std::log1p(-u) / sigma_per_mm;
}

Vec3 sample_ggx_visible_normal(Vec2 u, Vec3 to_eye, float alpha) {
    // Stretched so that the surface has roughness 1, where visible normals project evenly onto a half disk
    // that is tilted towards the eye.
    const Vec3 stretched = normalize(Vec3{alpha * to_eye.x, alpha * to_eye.y, to_eye.z});
    const LocalFrame frame = frame_of(stretched);
    const float radius = std::sqrt(u.x), azimuth = 2 * kPi * u.y;
    // The tilted axis must lie in the plane of the normal, so the frame is built from it.
    const float flat = stretched.x * stretched.x + stretched.y * stretched.y;
    const Vec3 t1 =
        flat > 1e-12f ? Vec3{-stretched.y, stretched.x, 0} * (1 / std::sqrt(flat)) : frame.tangent;
    const Vec3 t2 = cross(stretched, t1);
    const float p1 = radius * std::cos(azimuth);
    const float lean = 0.5f * (1 + stretched.z);
    const float p2 = (1 - lean) * std::sqrt(std::max(0.0f, 1 - p1 * p1)) + lean * radius * std::sin(azimuth);
    const float p3 = std::sqrt(std::max(0.0f, 1 - p1 * p1 - p2 * p2));
    const Vec3 normal = t1 * p1 + t2 * p2 + stretched * p3;
    return normalize(Vec3{alpha * normal.x, alpha * normal.y, std::max(1e-6f, normal.z)});
}

float ggx_visible_normal_density(Vec3 half_vector, Vec3 to_eye, float alpha) {
    const float a2 = alpha * alpha;
    const float d = half_vector.z * half_vector.z * (a2 - 1) + 1;
    const float distribution = a2 / (kPi * d * d);
    const float slope2 = (to_eye.x * to_eye.x + to_eye.y * to_eye.y) / (to_eye.z * to_eye.z);
    const float masking = 2 / (1 + std::sqrt(1 + a2 * slope2));
    return masking * std::max(0.0f, dot(half_vector, to_eye)) * distribution / to_eye.z;
}

}  // namespace dermis::inline rays
