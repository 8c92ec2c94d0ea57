#include "dermis/render/diffused_normals_textures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "dermis/base/parallel.h"
#include "dermis/optics/diffused_normals.h"

namespace dermis::inline render {
namespace {

// A texel of one level: the means of red and green, and how unevenly red's normals spread. All 0: no skin.
struct MeanNormals {
    Vec3 red, green;
    Vec2 uneven;
};

struct Level {
    int size = 0;
    std::vector<MeanNormals> texels;
};

Level finest(const DiffusedNormals& normals) {
    Level level{.size = normals.size, .texels = std::vector<MeanNormals>(normals.red.size())};
    const auto part = [](uint16_t x) { return 2 * float(x) / 65535 - 1; };
    parallel_for(level.texels.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const DiffusedNormals::Texel &r = normals.red[i], &g = normals.green[i];
            const Vec3 red{part(r[0]), part(r[1]), part(r[2])};
            if (dot(red, red) < 1e-6f) continue;
            level.texels[i] = {red, {part(g[0]), part(g[1]), part(g[2])}, {part(r[3]), part(g[3])}};
        }
    });
    return level;
}

// Of the texels with skin alone: a chart's border is no spread of normals.
Level halved(const Level& level) {
    Level half{.size = std::max(level.size / 2, 1), .texels = {}};
    half.texels.resize(size_t(half.size) * size_t(half.size));
    for (int y = 0; y < half.size; ++y)
        for (int x = 0; x < half.size; ++x) {
            MeanNormals sum;
            float count = 0;
            for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
                const int from_x = std::min(2 * x + dx, level.size - 1),
                          from_y = std::min(2 * y + dy, level.size - 1);
                const MeanNormals& texel = level.texels[size_t(from_y) * size_t(level.size) + size_t(from_x)];
                if (dot(texel.red, texel.red) == 0) continue;
                sum.red += texel.red, sum.green += texel.green, sum.uneven = sum.uneven + texel.uneven;
                ++count;
            }
            if (count == 0) continue;
            const float part = 1 / count;
            half.texels[size_t(y) * size_t(half.size) + size_t(x)] = {sum.red * part, sum.green * part,
                                                                      sum.uneven * part};
        }
    return half;
}

uint32_t unsigned_normalised(float x, uint32_t largest) {
    return uint32_t(std::clamp(x, 0.0f, 1.0f) * float(largest) + 0.5f);
}

uint32_t signed_normalised(float x, uint32_t largest) {
    return unsigned_normalised(0.5f * x + 0.5f, largest);
}

std::array<uint32_t, 3> direction(Vec3 mean, uint32_t largest) {
    const Vec3 n = normalize(mean);
    return {signed_normalised(n.x, largest), signed_normalised(n.y, largest),
            signed_normalised(n.z, largest)};
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& texel) {
    const auto* begin = reinterpret_cast<const std::byte*>(&texel);
    bytes.insert(bytes.end(), begin, begin + sizeof texel);
}

// Low bits first, as VK_FORMAT_A2B10G10R10_UNORM_PACK32.
void append_red(std::vector<std::byte>& bytes, const MeanNormals& texel) {
    const std::array<uint32_t, 3> n = direction(texel.red, 1023);
    append(bytes, n[0] | n[1] << 10 | n[2] << 20);
}

// Small differences in small steps; 0 is a code of its own.
uint8_t signed_root(float x) {
    const float root = std::copysign(std::sqrt(std::min(std::abs(x), 1.0f)), x);
    return uint8_t(std::lround(128 + 127 * root));
}

void append_green(std::vector<std::byte>& bytes, const MeanNormals& texel) {
    const Vec3 apart = normalize(texel.green) - normalize(texel.red);
    const float less = std::sqrt(std::max(1 - length(texel.red), 0.0f));
    append(bytes, std::array<uint8_t, 4>{signed_root(apart.x), signed_root(apart.y), signed_root(apart.z),
                                         uint8_t(unsigned_normalised(less, 255))});
}

void append_uneven(std::vector<std::byte>& bytes, const MeanNormals& texel) {
    append(bytes, std::array<uint8_t, 2>{uint8_t(signed_normalised(texel.uneven.x, 255)),
                                         uint8_t(signed_normalised(texel.uneven.y, 255))});
}

}  // namespace

std::vector<gpu::TextureData> diffused_normals_textures(const DiffusedNormals& normals) {
    const auto [red, green, uneven] = kDiffusedNormalsTextures;
    std::vector<gpu::TextureData> textures;
    for (const auto& [name, format] :
         {std::pair{red, ImageFormat::rgb10a2}, {green, ImageFormat::rgba8}, {uneven, ImageFormat::rg8}})
        textures.push_back({.name = name,
                            .format = format,
                            .width = normals.size,
                            .height = normals.size,
                            .mips = int(std::bit_width(unsigned(normals.size)))});
    for (Level level = finest(normals);; level = halved(level)) {
        for (const MeanNormals& texel : level.texels) {
            append_red(textures[0].bytes, texel);
            append_green(textures[1].bytes, texel);
            append_uneven(textures[2].bytes, texel);
        }
        if (level.size == 1) return textures;
    }
}

}  // namespace dermis::inline render
