#include "dermis/reference/split_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dermis/image/half.h"
#include "dermis/scene/cube_map.h"

namespace dermis::inline reference {
namespace {

Vec3 blend(Vec3 a, Vec3 b, float t) {
    return a * (1 - t) + b * t;
}

}  // namespace

float specular_occlusion(float n_dot_v, float occlusion, float roughness) {
    const float exponent = std::exp2(-16 * roughness - 1);
    return std::clamp(std::pow(n_dot_v + occlusion, exponent) - 1 + occlusion, 0.0f, 1.0f);
}

Result<SplitSumReflection> SplitSumReflection::load(const Environment& environment) {
    SplitSumReflection reflection;
    if (environment.kind == EnvironmentKind::none || environment.intensity <= 0) return reflection;
    DERMIS_TRY_ASSIGN(EnvironmentLight light, prepare_environment(environment));
    DERMIS_TRY_ASSIGN(BrdfTable brdf, BrdfTable::load());
    reflection.light_ = std::move(light);
    reflection.brdf_ = std::move(brdf);
    reflection.intensity_ = environment.intensity;
    reflection.yaw_rad_ = environment.yaw_rad;
    size_t start = 0;
    for (int level = 0; level < reflection.light_.mips; ++level) {
        reflection.level_starts_.push_back(start);
        const auto size = size_t(reflection.light_.base_size >> level);
        start += 6 * size * size * 4;
    }
    return reflection;
}

Vec3 SplitSumReflection::texel(int level, int face, int x, int y) const {
    const int size = light_.base_size >> level;
    // Beyond an edge the neighbouring face is read, as Vulkan filters cubes.
    if (x < 0 || y < 0 || x >= size || y >= size) {
        const CubePoint p = cube_point(
            cube_direction(face, (float(x) + 0.5f) / float(size), (float(y) + 0.5f) / float(size)));
        face = p.face;
        x = std::clamp(int(p.s * float(size)), 0, size - 1);
        y = std::clamp(int(p.t * float(size)), 0, size - 1);
    }
    const size_t row = size_t(face) * size_t(size) + size_t(y);
    uint16_t half[3];
    std::memcpy(half, &light_.cube[2 * (level_starts_[size_t(level)] + 4 * (row * size_t(size) + size_t(x)))],
                sizeof half);
    return {from_half(half[0]), from_half(half[1]), from_half(half[2])};
}

Vec3 SplitSumReflection::cube_level(Vec3 d, int level) const {
    const float size = float(light_.base_size >> level);
    const CubePoint point = cube_point(d);
    const float x = point.s * size - 0.5f, y = point.t * size - 0.5f;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const float fx = x - float(x0), fy = y - float(y0);
    return blend(blend(texel(level, point.face, x0, y0), texel(level, point.face, x0 + 1, y0), fx),
                 blend(texel(level, point.face, x0, y0 + 1), texel(level, point.face, x0 + 1, y0 + 1), fx),
                 fy);
}

Vec3 SplitSumReflection::cube(Vec3 d, float level) const {
    const float clamped = std::clamp(level, 0.0f, float(light_.mips - 1));
    const int low = int(clamped), high = std::min(low + 1, light_.mips - 1);
    return blend(cube_level(d, low), cube_level(d, high), clamped - float(low));
}

Vec3 SplitSumReflection::radiance(Vec3 n, Vec3 to_eye, float roughness, float f0, float occlusion) const {
    if (intensity_ <= 0) return {};
    const float n_dot_v = std::clamp(dot(n, to_eye), 1e-3f, 1.0f);
    const Vec3 reflected = n * (2 * dot(n, to_eye)) - to_eye;
    const Vec4 brdf = brdf_.at(kBrdfLobeGgx, roughness, n_dot_v);
    return cube(to_environment(reflected, yaw_rad_), roughness * float(light_.mips - 1)) *
           (intensity_ * (f0 * brdf.x + brdf.y) * specular_occlusion(n_dot_v, occlusion, roughness));
}

}  // namespace dermis::inline reference
