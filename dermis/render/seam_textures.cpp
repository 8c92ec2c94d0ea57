#include "dermis/render/seam_textures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "dermis/base/parallel.h"
#include "dermis/image/half.h"
#include "dermis/mesh/uv_report.h"
#include "dermis/mesh/uv_seams.h"
#include "dermis/optics/diffused_normals.h"
#include "dermis/scene/skin_atlas.h"

namespace dermis::inline render {
namespace {

void put_half(std::byte* target, float value) {
    const uint16_t half = to_half(value);
    std::memcpy(target, &half, sizeof half);
}

// x / 8 and rest, y / 8 and rest: half floats hold both parts to 1/256 texel up to 16384.
std::vector<std::byte> packed(const std::vector<Vec2>& carried) {
    std::vector<std::byte> bytes(carried.size() * 8);
    for (size_t i = 0; i < carried.size(); ++i) {
        const float parts[2] = {carried[i].x, carried[i].y};
        for (size_t k = 0; k < 2; ++k) {
            const float eighth = parts[k] < 0 ? -1 : std::floor(parts[k] / 8);
            put_half(&bytes[i * 8 + k * 4], eighth);
            put_half(&bytes[i * 8 + k * 4 + 2], parts[k] < 0 ? 0 : parts[k] - 8 * eighth);
        }
    }
    return bytes;
}

// UVs of the built-in head and of the head scan cover 0.88 and 0.92 of their tile.
constexpr double kCoverageOfCleanAtlas = 0.9;

struct AreaSample {
    float value = 0, area_mm2 = 0;
};

// The value that is not exceeded on `share` of the area; 0 without samples.
float quantile(std::vector<AreaSample>& samples, double share) {
    double total = 0, sum = 0;
    for (const AreaSample& sample : samples) total += double(sample.area_mm2);
    std::ranges::sort(samples, {}, &AreaSample::value);
    for (const AreaSample& sample : samples)
        if ((sum += double(sample.area_mm2)) >= share * total) return sample.value;
    return 0;
}

}  // namespace

Result<SeamTextures> make_seam_textures(gpu::Device& device, const Scene& scene, const SeamRequest& request) {
    const SkinParts skin = skin_over_atlas(scene);
    const SeamMap map = make_seam_map(skin.parts, request.size, request.width_texels);
    DERMIS_TRY_ASSIGN(gpu::Texture seams, gpu::Texture::upload(device, {.name = "seam_map",
                                                                        .format = ImageFormat::rgba16f,
                                                                        .width = map.size,
                                                                        .height = map.size,
                                                                        .bytes = packed(map.carried)}));
    const auto charts = std::as_bytes(std::span(map.chart));
    DERMIS_TRY_ASSIGN(gpu::Texture chart,
                      gpu::Texture::upload(device, {.name = "chart_map",
                                                    .format = ImageFormat::r8,
                                                    .width = map.size,
                                                    .height = map.size,
                                                    .bytes = {charts.begin(), charts.end()}}));
    return SeamTextures{request, std::move(seams), std::move(chart)};
}

bool has_skin(const SceneObject& object) {
    return std::ranges::find(object.classes, MaterialClass::skin) != object.classes.end();
}

// So that skin has as many texels as in UVs of one tile that were made for the head.
float light_map_scale_of(const Scene& scene, double covered_uv) {
    constexpr float kMostScale = 2;
    const bool is_laid_out = std::ranges::any_of(scene.objects, [](const SceneObject& object) {
        return !object.mesh.atlas_uvs.empty() && has_skin(object);
    });
    if (!is_laid_out || !(covered_uv > 0)) return 1;
    return std::clamp(float(std::sqrt(kCoverageOfCleanAtlas / covered_uv)), 1.0f, kMostScale);
}

UvDensity uv_density(const Scene& scene) {
    std::vector<AreaSample> densest, typical;  // UV per mm
    double covered_uv = 0;
    const SkinParts skin = skin_over_atlas(scene);
    for (const AtlasPart& part : skin.parts) {
        const std::vector<UvMetric> metrics = triangle_uv_metrics(*part.mesh);
        const std::vector<float> areas = triangle_areas_mm2(*part.mesh);
        for (const uint32_t triangle : part.triangles) {
            const UvMetric& m = metrics[triangle];
            // The smaller eigenvalue of the form: the shortest image of a step of 1 in UV, squared.
            const double mean = (double(m.e_mm2) + m.g_mm2) / 2, half = (double(m.e_mm2) - m.g_mm2) / 2;
            const double least = mean - std::sqrt(half * half + double(m.f_mm2) * m.f_mm2);
            if (!(least > 1e-6 * mean)) continue;
            covered_uv += double(areas[triangle]) / (double(m.mm_per_uv()) * double(m.mm_per_uv()));
            densest.push_back({float(1 / std::sqrt(least)), areas[triangle]});
            typical.push_back({1 / m.mm_per_uv(), areas[triangle]});
        }
    }
    return {quantile(densest, 0.99), quantile(typical, 0.5), light_map_scale_of(scene, covered_uv)};
}

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
