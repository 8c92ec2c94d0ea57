#include "dermis/scene/panorama.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/angle.h"
#include "dermis/base/parallel.h"
#include "dermis/image/half.h"
#include "dermis/scene/scene.h"

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

namespace {

// A rectangle that faces the scene; angles as of lights and cameras.
struct SoftBox {
    float yaw_deg, pitch_deg, half_width_deg, half_height_deg;
    Vec3 radiance_linear;
};

constexpr SoftBox kBoxes[] = {
    {-50, 35, 26, 22, {1.90f, 1.70f, 1.45f}},  // key, warm
    {62, 8, 24, 34, {0.34f, 0.39f, 0.46f}},    // fill, cool
    {152, 18, 6, 40, {2.5f, 2.6f, 2.8f}},      // rim, right
    {-146, 22, 5, 36, {1.8f, 1.8f, 1.8f}},     // rim, left
    {0, 80, 20, 20, {0.50f, 0.50f, 0.52f}},    // overhead
};

float smooth_step(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

// The point where the direction meets the box's plane at distance 1, divided by its half sides: -1..1 inside.
// The cloth is brightest in the middle; the edge is soft over a tenth of the box.
float box_shape(const SoftBox& box, Vec3 d) {
    const Vec3 axis =
        direction_from_yaw_pitch(box.yaw_deg * kRadiansPerDegree, box.pitch_deg * kRadiansPerDegree);
    const float along = dot(d, axis);
    if (along <= 0) return 0;
    const Vec3 right = normalize(cross(Vec3{0, 1, 0}, axis));
    const Vec3 up = cross(axis, right);
    const float a = dot(d, right) / along / std::tan(box.half_width_deg * kRadiansPerDegree);
    const float b = dot(d, up) / along / std::tan(box.half_height_deg * kRadiansPerDegree);
    const float edge = smooth_step(1.05f, 0.9f, std::abs(a)) * smooth_step(1.05f, 0.9f, std::abs(b));
    return edge * (1.15f - 0.3f * std::min((a * a + b * b) / 2, 1.0f));
}

// A grey room: dark floor with warm reflected light, walls that get darker upwards.
Vec3 room_radiance(Vec3 d) {
    const Vec3 floor = {0.045f, 0.040f, 0.036f}, wall = {0.085f, 0.087f, 0.092f},
               ceiling = {0.050f, 0.052f, 0.056f};
    const float down = smooth_step(0.02f, -0.35f, d.y), up = smooth_step(0.1f, 0.9f, d.y);
    return wall * ((1 - down) * (1 - up)) + floor * down + ceiling * up;
}

}  // namespace

Vec3 studio_radiance(Vec3 d) {
    Vec3 radiance = room_radiance(d);
    for (const SoftBox& box : kBoxes) radiance += box.radiance_linear * box_shape(box, d);
    return radiance;
}

Image make_studio_panorama(int width) {
    Image image(width, width / 2, 3);
    const std::span<float> values = image.floats();
    parallel_for(size_t(image.height), 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < size_t(image.width); ++x) {
                Vec3 sum;
                for (const Vec2 offset : {Vec2{0.25f, 0.25f}, {0.75f, 0.25f}, {0.25f, 0.75f}, {0.75f, 0.75f}})
                    sum += studio_radiance(panorama_direction((float(x) + offset.x) / float(image.width),
                                                              (float(y) + offset.y) / float(image.height)));
                float* rgb = &values[3 * (y * size_t(image.width) + x)];
                rgb[0] = sum.x / 4, rgb[1] = sum.y / 4, rgb[2] = sum.z / 4;
            }
    });
    return image;
}

}  // namespace dermis::inline scene
