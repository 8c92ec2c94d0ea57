#include "dermis/reference/texture.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/colour.h"

namespace dermis {
namespace {

// The channel of the image that stands in for red, green, blue or alpha; -1: nothing, take 1.
int source_channel(int channels, int wanted) {
    if (wanted == 3) return channels == 4 ? 3 : channels == 2 ? 1 : -1;
    return channels <= 2 ? 0 : wanted;
}

}  // namespace

Texture::Texture(const Image& image) : width_(image.width), height_(image.height), channels_(image.channels) {
    const bool eight_bits = image.format == PixelFormat::u8;
    for (int i = 0; i < 256; ++i) {
        const float value = float(i) / 255;
        decoded_[size_t(i)] = image.encoding == Encoding::srgb ? srgb_decode(value) : value;
    }
    if (eight_bits) {
        bytes_.resize(image.pixel_count(), {255, 255, 255, 255});
        const auto* from = reinterpret_cast<const uint8_t*>(image.bytes.data());
        for (size_t i = 0; i < bytes_.size(); ++i)
            for (int c = 0; c < 4; ++c)
                if (const int source = source_channel(channels_, c); source >= 0)
                    bytes_[i][size_t(c)] = from[i * size_t(channels_) + size_t(source)];
        return;
    }
    const Image linear = to_linear_float(image);
    const std::span<const float> from = linear.floats();
    floats_.resize(image.pixel_count());
    for (size_t i = 0; i < floats_.size(); ++i) {
        float value[4];
        for (int c = 0; c < 4; ++c) {
            const int source = source_channel(channels_, c);
            value[c] = source >= 0 ? from[i * size_t(channels_) + size_t(source)] : 1.0f;
        }
        floats_[i] = {value[0], value[1], value[2], value[3]};
    }
}

Vec4 Texture::texel(int x, int y) const {
    const size_t i = size_t(y) * size_t(width_) + size_t(x);
    if (bytes_.empty()) return floats_[i];
    const std::array<uint8_t, 4> b = bytes_[i];
    return {decoded_[b[0]], decoded_[b[1]], decoded_[b[2]], float(b[3]) / 255};
}

Vec4 Texture::sample(Vec2 uv) const {
    const float x = (uv.x - std::floor(uv.x)) * float(width_) - 0.5f;
    const float y = (uv.y - std::floor(uv.y)) * float(height_) - 0.5f;
    const float x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
    // uv of NaN or infinity would index anywhere: such a point reads the first texel.
    const auto wrapped = [](float at, int size) {
        const int i = at >= -1 && at <= float(size) ? int(at) : 0;
        return i < 0 ? i + size : i >= size ? i - size : i;
    };
    const int left = wrapped(x0, width_), right = wrapped(x0 + 1, width_);
    const int top = wrapped(y0, height_), bottom = wrapped(y0 + 1, height_);
    const Vec4 a = texel(left, top), b = texel(right, top), c = texel(left, bottom), d = texel(right, bottom);
    const float wa = (1 - fx) * (1 - fy), wb = fx * (1 - fy), wc = (1 - fx) * fy, wd = fx * fy;
    return {a.x * wa + b.x * wb + c.x * wc + d.x * wd, a.y * wa + b.y * wb + c.y * wc + d.y * wd,
            a.z * wa + b.z * wb + c.z * wc + d.z * wd, a.w * wa + b.w * wb + c.w * wc + d.w * wd};
}

}  // namespace dermis
