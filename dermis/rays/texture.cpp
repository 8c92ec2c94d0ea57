#include "dermis/rays/texture.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/colour.h"
#include "dermis/scene/image_source.h"

namespace dermis::inline rays {
namespace {

// The channel of the image that is read as red, green, blue or alpha; -1: none, the value is 1.
int source_channel(int channels, int wanted) {
    if (wanted == 3) return channels == 4 ? 3 : channels == 2 ? 1 : -1;
    return channels <= 2 ? 0 : wanted;
}

// Two texels of a row or column and the weight of the second.
struct TexelPair {
    int first = 0, second = 0;
    float weight = 0;
};

// A coordinate of NaN or infinity reads the first texel instead of an arbitrary address.
TexelPair texel_pair(float at, int size, TextureWrap wrap) {
    const float period = wrap == TextureWrap::mirror ? 2.0f : 1.0f;
    float inside =
        wrap == TextureWrap::clamp ? std::clamp(at, 0.0f, 1.0f) : at - period * std::floor(at / period);
    if (!(inside >= 0 && inside <= period)) inside = 0;
    const float position = inside * float(size) - 0.5f;
    const float low = position < 0 ? -1.0f : float(int(position));  // of -0.5 upwards
    const auto texel = [&](int i) {
        if (wrap == TextureWrap::repeat) return i < 0 ? i + size : i >= size ? i - size : i;
        if (wrap == TextureWrap::mirror && i >= size) i = 2 * size - 1 - i;
        return std::clamp(i, 0, size - 1);
    };
    return {texel(int(low)), texel(int(low) + 1), position - low};
}

// Bilinear mean of the four texels around a point.
Vec4 mix(Vec4 a, Vec4 b, Vec4 c, Vec4 d, float fx, float fy) {
    const float wa = (1 - fx) * (1 - fy), wb = fx * (1 - fy), wc = (1 - fx) * fy, wd = fx * fy;
    return {a.x * wa + b.x * wb + c.x * wc + d.x * wd, a.y * wa + b.y * wb + c.y * wc + d.y * wd,
            a.z * wa + b.z * wb + c.z * wc + d.z * wd, a.w * wa + b.w * wb + c.w * wc + d.w * wd};
}

}  // namespace

Texture::Texture(const Image& image, TextureWrap u, TextureWrap v)
    : channels_(image.channels), wrap_u_(u), wrap_v_(v), encoded_(image.encoding == Encoding::srgb) {
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
    return level.bytes.empty() ? level.floats[i] : decoded(level.bytes[i]);
}

inline Vec4 Texture::decoded(std::array<uint8_t, 4> b) const {
    return {decoded_[b[0]], decoded_[b[1]], decoded_[b[2]], float(b[3]) / 255};
}

Vec4 Texture::sample_level(const Level& level, Vec2 uv) const {
    const TexelPair x = texel_pair(uv.x, level.width, wrap_u_), y = texel_pair(uv.y, level.height, wrap_v_);
    const auto mixed = [&](const auto& texel_of) {
        const size_t row = size_t(y.first) * size_t(level.width),
                     below = size_t(y.second) * size_t(level.width);
        return mix(texel_of(row + size_t(x.first)), texel_of(row + size_t(x.second)),
                   texel_of(below + size_t(x.first)), texel_of(below + size_t(x.second)), x.weight, y.weight);
    };
    if (level.bytes.empty()) return mixed([&](size_t i) { return level.floats[i]; });
    return mixed([&](size_t i) { return decoded(level.bytes[i]); });
}

Vec4 Texture::sample(Vec2 uv, const UvFootprint& footprint) const {
    const auto texels = [&](Vec2 side) {
        return std::hypot(side.x * float(levels_[0].width), side.y * float(levels_[0].height));
    };
    if (footprint.is_zero()) return sample_level(levels_[0], uv);
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

Result<std::unique_ptr<CutOutMap>> CutOutMap::load(const SceneObject& object, uint32_t number) {
    const Material& material = object.mesh.materials[number];
    const bool may_be = number < object.classes.size() && object.classes[number] == MaterialClass::other;
    const float cutoff = may_be ? cutoff_of_map(material) : 0;
    if (cutoff == 0 && !(may_be && is_blended(material))) return std::unique_ptr<CutOutMap>();
    DERMIS_TRY_ASSIGN(const Image alpha, load_alpha(cutoff > 0 ? material : Material{}));
    const ImageSource& source = material.alpha_map.present() ? material.alpha_map : material.base_color_map;
    return std::unique_ptr<CutOutMap>(new CutOutMap(object.mesh, cutoff, is_blended(material),
                                                    Texture(alpha, source.wrap_u, source.wrap_v)));
}

float CutOutMap::alpha(uint32_t triangle, float u, float v) const {
    const uint32_t* corner = &mesh_->indices[3 * size_t(triangle)];
    const float weight[3] = {1 - u - v, u, v};
    Vec2 uv;
    float alpha = mesh_->colors_linear.empty() ? 1.0f : 0.0f;
    for (int i = 0; i < 3; ++i) {
        if (!mesh_->uvs.empty()) uv = uv + mesh_->uvs[corner[i]] * weight[i];
        if (!mesh_->colors_linear.empty()) alpha += mesh_->colors_linear[corner[i]].w * weight[i];
    }
    return alpha * alpha_.sample(uv).x;
}

}  // namespace dermis::inline rays
