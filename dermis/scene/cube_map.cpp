#include "dermis/scene/cube_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/parallel.h"
#include "dermis/scene/panorama.h"

namespace dermis::inline scene {
namespace {

Vec3 mix(Vec3 a, Vec3 b, float t) {
    return a * (1 - t) + b * t;
}

Vec3 supersampled(const Image& panorama, int face, int x, int y, int size) {
    constexpr int kSide = 2;
    Vec3 sum;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const float s = (float(x) + (float(i) + 0.5f) / kSide) / float(size);
            const float t = (float(y) + (float(j) + 0.5f) / kSide) / float(size);
            sum += panorama_radiance(panorama, cube_direction(face, s, t));
        }
    return sum * (1.0f / (kSide * kSide));
}

// Relative solid angles of the texels of a face, rows of x; the same for all six.
std::vector<float> texel_solid_angles(int size) {
    std::vector<float> angles;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const Vec3 p =
                cube_direction(4, (float(x) + 0.5f) / float(size), (float(y) + 0.5f) / float(size));
            angles.push_back(std::pow(dot(p, p), -1.5f));
        }
    return angles;
}

}  // namespace

Vec3 cube_direction(int face, float s, float t) {
    const float a = 2 * s - 1, b = 2 * t - 1;
    switch (face) {
        case 0:
            return {1, -b, -a};
        case 1:
            return {-1, -b, a};
        case 2:
            return {a, 1, b};
        case 3:
            return {a, -1, -b};
        case 4:
            return {a, -b, 1};
        default:
            return {-a, -b, -1};
    }
}

CubePoint cube_point(Vec3 d) {
    const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    float a, b, major;
    int face;
    if (x >= y && x >= z)
        face = d.x > 0 ? 0 : 1, major = x, a = d.x > 0 ? -d.z : d.z, b = -d.y;
    else if (y >= z)
        face = d.y > 0 ? 2 : 3, major = y, a = d.x, b = d.y > 0 ? d.z : -d.z;
    else
        face = d.z > 0 ? 4 : 5, major = z, a = d.z > 0 ? d.x : -d.x, b = -d.y;
    return {face, (a / major + 1) / 2, (b / major + 1) / 2};
}

float cube_texel_solid_angle(int size) {
    return 4 * std::numbers::pi_v<float> / (6 * float(size) * float(size));
}

CubePyramid::CubePyramid(const Image& panorama, int size) {
    Level& base = levels_.emplace_back(size);
    parallel_for(size_t(6 * size), 4, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row)
            for (int x = 0; x < size; ++x) {
                const int face = int(row) / size, y = int(row) % size;
                base.at(face, x, y) = supersampled(panorama, face, x, y, size);
            }
    });
    std::vector<float> solid_angles = texel_solid_angles(size);
    while (levels_.back().size > 1) levels_.push_back(half_size(levels_.back(), solid_angles));
    for (Level& level : levels_) level.fill_borders();
}

// Means weighted by solid angle, because texels in a corner are smaller. `solid_angles`
// become those of the new level.
CubePyramid::Level CubePyramid::half_size(const Level& level, std::vector<float>& solid_angles) {
    Level half(level.size / 2);
    std::vector<float> sums(size_t(half.size) * size_t(half.size));
    for (int y = 0; y < level.size; ++y)
        for (int x = 0; x < level.size; ++x) {
            const float weight = solid_angles[size_t(y) * size_t(level.size) + size_t(x)];
            sums[size_t(y / 2) * size_t(half.size) + size_t(x / 2)] += weight;
            for (int face = 0; face < 6; ++face) half.at(face, x / 2, y / 2) += level.at(face, x, y) * weight;
        }
    for (int y = 0; y < half.size; ++y)
        for (int x = 0; x < half.size; ++x)
            for (int face = 0; face < 6; ++face)
                half.at(face, x, y) *= 1 / sums[size_t(y) * size_t(half.size) + size_t(x)];
    solid_angles = std::move(sums);
    return half;
}

// A border texel copies the nearest texel of the neighbouring face; in a corner, where three texels meet, it
// is the mean of the three.
void CubePyramid::Level::fill_borders() {
    const auto neighbour = [&](int face, int x, int y) {
        const CubePoint p = cube_point(
            cube_direction(face, (float(x) + 0.5f) / float(size), (float(y) + 0.5f) / float(size)));
        const auto texel = [&](float s) { return std::clamp(int(s * float(size)), 0, size - 1); };
        return at(p.face, texel(p.s), texel(p.t));
    };
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < size; ++i) {
            at(face, i, -1) = neighbour(face, i, -1);
            at(face, i, size) = neighbour(face, i, size);
            at(face, -1, i) = neighbour(face, -1, i);
            at(face, size, i) = neighbour(face, size, i);
        }
        for (const int outer_x : {-1, size})
            for (const int outer_y : {-1, size}) {
                const int x = std::clamp(outer_x, 0, size - 1), y = std::clamp(outer_y, 0, size - 1);
                at(face, outer_x, outer_y) =
                    (at(face, x, y) + at(face, outer_x, y) + at(face, x, outer_y)) * (1.0f / 3);
            }
    }
}

Vec3 CubePyramid::Level::sample(const CubePoint& point) const {
    const float x = point.s * float(size) - 0.5f, y = point.t * float(size) - 0.5f;
    const int x0 = std::clamp(int(std::floor(x)), -1, size - 1),
              y0 = std::clamp(int(std::floor(y)), -1, size - 1);
    const float fx = x - float(x0), fy = y - float(y0);
    return mix(mix(at(point.face, x0, y0), at(point.face, x0 + 1, y0), fx),
               mix(at(point.face, x0, y0 + 1), at(point.face, x0 + 1, y0 + 1), fx), fy);
}

Vec3 CubePyramid::sample(Vec3 d, float level) const {
    const float clamped = std::clamp(level, 0.0f, float(levels_.size() - 1));
    const size_t low = std::min(size_t(clamped), levels_.size() - 1),
                 high = std::min(low + 1, levels_.size() - 1);
    const CubePoint point = cube_point(d);
    const float t = clamped - float(low);
    const Vec3 fine = levels_[low].sample(point);
    return t > 0 ? mix(fine, levels_[high].sample(point), t) : fine;
}

Vec3 CubePyramid::texel(int level, int face, int x, int y) const {
    return levels_[size_t(level)].at(face, x, y);
}

}  // namespace dermis::inline scene
