#include "dermis/scene/panorama.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/angle.h"
#include "dermis/image/half.h"

namespace dermis::inline scene {
namespace {

float clean(float value) {
    return value > 0 ? std::min(value, kMaxHalf) : 0.0f;  // a NaN compares false
}

Vec3 texel(std::span<const float> values, int width, int x, int y) {
    const float* rgb = &values[3 * (size_t(y) * size_t(width) + size_t(x))];
    return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace

Vec3 panorama_direction(float u, float v) {
    const float azimuth = (u - 0.5f) * 2 * kPi, polar = v * kPi;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

Vec2 panorama_uv(Vec3 d) {
    return {0.5f + std::atan2(d.x, -d.z) / (2 * kPi), std::atan2(std::hypot(d.x, d.z), d.y) / kPi};
}

Vec3 panorama_radiance(const Image& panorama, Vec3 d) {
    return panorama_radiance(panorama, panorama_uv(d));
}

Vec3 panorama_radiance(const Image& panorama, Vec2 uv) {
    const float x = uv.x * float(panorama.width) - 0.5f;
    const float y = std::clamp(uv.y * float(panorama.height) - 0.5f, 0.0f, float(panorama.height - 1));
    const int x0 = int(std::floor(x)), y0 = int(y);
    const float fx = x - float(x0), fy = y - float(y0);
    const int left = (x0 + panorama.width) % panorama.width, right = (left + 1) % panorama.width;
    const int below = std::min(y0 + 1, panorama.height - 1);
    const std::span<const float> values = panorama.floats();
    const auto at = [&](int column, int row) { return texel(values, panorama.width, column, row); };
    return (at(left, y0) * (1 - fx) + at(right, y0) * fx) * (1 - fy) +
           (at(left, below) * (1 - fx) + at(right, below) * fx) * fy;
}

float panorama_texel_solid_angle(const Image& panorama, int row) {
    const double step = std::numbers::pi / panorama.height;
    const double band = std::cos(row * step) - std::cos((row + 1) * step);
    return float(band * 2 * std::numbers::pi / panorama.width);
}

Image clean_panorama(const Image& linear_float, int max_width) {
    int factor = 1;
    while (linear_float.width / factor > max_width) ++factor;
    Image result(std::max(linear_float.width / factor, 1), std::max(linear_float.height / factor, 1), 3);
    const std::span<const float> from = linear_float.floats();
    const std::span<float> to = result.floats();
    const int channels = linear_float.channels;
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int c = 0; c < 3; ++c) {
                float sum = 0;
                for (int j = 0; j < factor; ++j)
                    for (int i = 0; i < factor; ++i) {
                        const size_t pixel =
                            size_t(y * factor + j) * size_t(linear_float.width) + size_t(x * factor + i);
                        sum += clean(from[pixel * size_t(channels) + size_t(channels < 3 ? 0 : c)]);
                    }
                to[3 * (size_t(y) * size_t(result.width) + size_t(x)) + size_t(c)] =
                    sum / float(factor * factor);
            }
    return result;
}

}  // namespace dermis::inline scene
