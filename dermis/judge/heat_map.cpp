#include "dermis/judge/heat_map.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace dermis::inline judge {
namespace {

// CIE L* of about 3, 22, 41, 60, 79, 96: equal steps, so that equal differences look equal.
constexpr Vec3 kStops[] = {{0.04f, 0.03f, 0.10f}, {0.29f, 0.10f, 0.45f}, {0.66f, 0.18f, 0.45f},
                           {0.93f, 0.40f, 0.27f}, {0.99f, 0.71f, 0.36f}, {0.99f, 0.97f, 0.78f}};
// From 0 outwards, of the same lightness on both sides: CIE L* of about 3, 33, 62, 92.
constexpr Vec3 kAbove[] = {
    {0.05f, 0.05f, 0.05f}, {0.60f, 0.13f, 0.12f}, {0.95f, 0.48f, 0.33f}, {1.00f, 0.89f, 0.75f}};
constexpr Vec3 kBelow[] = {
    {0.05f, 0.05f, 0.05f}, {0.10f, 0.29f, 0.62f}, {0.33f, 0.62f, 0.92f}, {0.78f, 0.93f, 1.00f}};
constexpr Vec3 kOutside = {0.11f, 0.11f, 0.12f};

// 0 is the first stop, 1 the last; clamped.
Vec3 between(std::span<const Vec3> stops, float value) {
    const size_t last = stops.size() - 1;
    const float at = (value > 0 ? std::min(value, 1.0f) : 0) * float(last);
    const size_t low = std::min(size_t(at), last - 1);
    return stops[low] + (stops[low + 1] - stops[low]) * (at - float(low));
}

template <class Color>
Image colored(const Image& mask, Color color) {
    Image picture(mask.width, mask.height, 3, PixelFormat::u8, Encoding::srgb);
    for (size_t i = 0; i < mask.pixel_count(); ++i) {
        const Vec3 c = mask.floats()[i] > 0 ? color(i) : kOutside;
        const float channels[3] = {c.x, c.y, c.z};
        for (size_t k = 0; k < 3; ++k)
            picture.values<uint8_t>()[3 * i + k] = uint8_t(std::lround(channels[k] * 255));
    }
    return picture;
}

}  // namespace

Vec3 heat_color(float value) {
    return between(kStops, value);
}

Image heat_map(const Image& values, double full, const Image& mask) {
    return colored(mask, [&](size_t i) { return heat_color(float(values.floats()[i] / full)); });
}

Vec3 signed_color(float value) {
    return value < 0 ? between(kBelow, -value) : between(kAbove, value);
}

Image signed_map(const Image& rgb, double full, const Image& mask) {
    return colored(mask, [&](size_t i) {
        const float* at = &rgb.floats()[3 * i];
        return signed_color(float((at[0] + at[1] + at[2]) / (3 * full)));
    });
}

}  // namespace dermis::inline judge
