#include "dermis/render/seam_textures.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dermis/image/half.h"
#include "dermis/mesh/uv_report.h"
#include "dermis/mesh/uv_seams.h"

namespace dermis::inline render {
namespace {

std::vector<AtlasPart> skin_parts(const Scene& scene) {
    std::vector<AtlasPart> parts;
    for (const SceneObject& object : scene.objects) {
        if (object.mesh.uvs.size() != object.mesh.positions_mm.size()) continue;
        AtlasPart part{.mesh = &object.mesh, .triangles = {}};
        for (const Submesh& submesh : object.mesh.submeshes) {
            if (object.classes[submesh.material] != MaterialClass::skin) continue;
            for (uint32_t i = 0; i < submesh.index_count / 3; ++i)
                part.triangles.push_back(submesh.first_index / 3 + i);
        }
        if (!part.triangles.empty()) parts.push_back(std::move(part));
    }
    return parts;
}

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
    const SeamMap map = make_seam_map(skin_parts(scene), request.size, request.width_texels);
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

UvDensity uv_density(const Scene& scene) {
    std::vector<AreaSample> densest, typical;  // UV per mm
    for (const AtlasPart& part : skin_parts(scene)) {
        const std::vector<UvMetric> metrics = triangle_uv_metrics(*part.mesh);
        const std::vector<float> areas = triangle_areas_mm2(*part.mesh);
        for (const uint32_t triangle : part.triangles) {
            const UvMetric& m = metrics[triangle];
            // The smaller eigenvalue of the form: the shortest image of a step of 1 in UV, squared.
            const double mean = (double(m.e_mm2) + m.g_mm2) / 2, half = (double(m.e_mm2) - m.g_mm2) / 2;
            const double least = mean - std::sqrt(half * half + double(m.f_mm2) * m.f_mm2);
            if (!(least > 1e-6 * mean)) continue;
            densest.push_back({float(1 / std::sqrt(least)), areas[triangle]});
            typical.push_back({1 / m.mm_per_uv(), areas[triangle]});
        }
    }
    return {quantile(densest, 0.99), quantile(typical, 0.5)};
}

}  // namespace dermis::inline render
