#include "dermis/judge/heat_map.h"

#include <algorithm>
#include <cmath>

namespace dermis {
namespace {

// CIE L* of about 3, 22, 41, 60, 79, 96: equal steps, so that equal differences look equal.
constexpr Vec3 kStops[] = {{0.04f, 0.03f, 0.10f}, {0.29f, 0.10f, 0.45f}, {0.66f, 0.18f, 0.45f},
                           {0.93f, 0.40f, 0.27f}, {0.99f, 0.71f, 0.36f}, {0.99f, 0.97f, 0.78f}};
constexpr Vec3 kOutside = {0.11f, 0.11f, 0.12f};

}  // namespace

Vec3 heat_color(float value) {
    constexpr int kLast = int(std::size(kStops)) - 1;
    const float at = (value > 0 ? std::min(value, 1.0f) : 0) * kLast;
    const int low = std::min(int(at), kLast - 1);
    return kStops[low] + (kStops[low + 1] - kStops[low]) * (at - float(low));
}

Image heat_map(const Image& values, double full, const Image& mask) {
    Image picture(values.width, values.height, 3, PixelFormat::u8, Encoding::srgb);
    for (size_t i = 0; i < values.pixel_count(); ++i) {
        const Vec3 c = mask.floats()[i] > 0 ? heat_color(float(values.floats()[i] / full)) : kOutside;
        const float channels[3] = {c.x, c.y, c.z};
        for (size_t k = 0; k < 3; ++k)
            picture.values<uint8_t>()[3 * i + k] = uint8_t(std::lround(channels[k] * 255));
    }
    return picture;
}

}  // namespace dermis
