#include "dermis/rays/texture.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/colour.h"

namespace dermis {
namespace {

// The channel of the image that is read as red, green, blue or alpha; -1: none, the value is 1.
int source_channel(int channels, int wanted) {
    if (wanted == 3) return channels == 4 ? 3 : channels == 2 ? 1 : -1;
    return channels <= 2 ? 0 : wanted;
}

}  // namespace

Texture::Texture(const Image& image) : channels_(image.channels), encoded_(image.encoding == Encoding::srgb) {
    for (int i = 0; i < 256; ++i) {
        const float value = float(i) / 255;
        decoded_[size_t(i)] = encoded_ ? srgb_decode(value) : value;
    }
    Level full{.width = image.width, .height = image.height};
    if (image.format == PixelFormat::u8) {
        full.bytes.resize(image.pixel_count(), {255, 255, 255, 255});
        const auto* from = reinterpret_cast<const uint8_t*>(image.bytes.data());
        for (size_t i = 0; i < full.bytes.size(); ++i)
            for (int c = 0; c < 4; ++c)
                if (const int source = source_channel(channels_, c); source >= 0)
                    full.bytes[i][size_t(c)] = from[i * size_t(channels_) + size_t(source)];
    } else {
        const Image linear = to_linear_float(image);
        const std::span<const float> from = linear.floats();
        full.floats.resize(image.pixel_count());
        for (size_t i = 0; i < full.floats.size(); ++i) {
            float value[4];
            for (int c = 0; c < 4; ++c) {
                const int source = source_channel(channels_, c);
                value[c] = source >= 0 ? from[i * size_t(channels_) + size_t(source)] : 1.0f;
            }
            full.floats[i] = {value[0], value[1], value[2], value[3]};
        }
    }
    levels_.push_back(std::move(full));
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back(half_size(levels_.back()));
}

// An odd side loses its last row: half a texel of the level; a GPU's blit spreads the difference over all
// rows.
Texture::Level Texture::half_size(const Level& level) const {
    Level half{.width = std::max(level.width / 2, 1), .height = std::max(level.height / 2, 1)};
    const size_t count = size_t(half.width) * size_t(half.height);
    const bool eight_bits = !level.bytes.empty();
    if (eight_bits)
        half.bytes.resize(count);
    else
        half.floats.resize(count);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x) {
            const int right = std::min(2 * x + 1, level.width - 1),
                      below = std::min(2 * y + 1, level.height - 1);
            const Vec4 a = texel(level, std::min(2 * x, right), std::min(2 * y, below)),
                       b = texel(level, right, std::min(2 * y, below)),
                       c = texel(level, std::min(2 * x, right), below), d = texel(level, right, below);
            const float mean[4] = {(a.x + b.x + c.x + d.x) / 4, (a.y + b.y + c.y + d.y) / 4,
                                   (a.z + b.z + c.z + d.z) / 4, (a.w + b.w + c.w + d.w) / 4};
            const size_t i = size_t(y) * size_t(half.width) + size_t(x);
            if (!eight_bits) {
                half.floats[i] = {mean[0], mean[1], mean[2], mean[3]};
                continue;
            }
            for (size_t k = 0; k < 4; ++k) {
                const float stored = encoded_ && k < 3 ? srgb_encode(mean[k]) : mean[k];
                half.bytes[i][k] = uint8_t(std::lround(std::clamp(stored, 0.0f, 1.0f) * 255));
            }
        }
    return half;
}

Vec4 Texture::texel(const Level& level, int x, int y) const {
    const size_t i = size_t(y) * size_t(level.width) + size_t(x);
    if (level.bytes.empty()) return level.floats[i];
    const std::array<uint8_t, 4> b = level.bytes[i];
    return {decoded_[b[0]], decoded_[b[1]], decoded_[b[2]], float(b[3]) / 255};
}

Vec4 Texture::sample_level(const Level& level, Vec2 uv) const {
    const float x = (uv.x - std::floor(uv.x)) * float(level.width) - 0.5f;
    const float y = (uv.y - std::floor(uv.y)) * float(level.height) - 0.5f;
    const float x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
    // A uv of NaN or infinity reads the first texel instead of an arbitrary address.
    const auto wrapped = [](float at, int size) {
        const int i = at >= -1 && at <= float(size) ? int(at) : 0;
        return i < 0 ? i + size : i >= size ? i - size : i;
    };
    const int left = wrapped(x0, level.width), right = wrapped(x0 + 1, level.width);
    const int top = wrapped(y0, level.height), bottom = wrapped(y0 + 1, level.height);
    const Vec4 a = texel(level, left, top), b = texel(level, right, top), c = texel(level, left, bottom),
               d = texel(level, right, bottom);
    const float wa = (1 - fx) * (1 - fy), wb = fx * (1 - fy), wc = (1 - fx) * fy, wd = fx * fy;
    return {a.x * wa + b.x * wb + c.x * wc + d.x * wd, a.y * wa + b.y * wb + c.y * wc + d.y * wd,
            a.z * wa + b.z * wb + c.z * wc + d.z * wd, a.w * wa + b.w * wb + c.w * wc + d.w * wd};
}

Vec4 Texture::sample(Vec2 uv, const UvFootprint& footprint) const {
    const auto texels = [&](Vec2 side) {
        return std::hypot(side.x * float(levels_[0].width), side.y * float(levels_[0].height));
    };
    const float longest = std::max(texels(footprint.across), texels(footprint.down));
    if (!(longest > 1)) return sample_level(levels_[0], uv);
    const float level = std::min(std::log2(longest), float(levels_.size() - 1));
    const size_t low = size_t(level), high = std::min(low + 1, levels_.size() - 1);
    const float t = level - float(low);
    const Vec4 fine = sample_level(levels_[low], uv);
    if (t == 0) return fine;
    const Vec4 coarse = sample_level(levels_[high], uv);
    const auto mix = [t](float a, float b) { return a + (b - a) * t; };
    return {mix(fine.x, coarse.x), mix(fine.y, coarse.y), mix(fine.z, coarse.z), mix(fine.w, coarse.w)};
}

}  // namespace dermis
