#include "dermis/engines/head_maps.h"

#include <algorithm>

#include "dermis/base/angle.h"
#include "dermis/base/parallel.h"
#include "dermis/engines/web/parts.h"
#include "dermis/image/dilate.h"
#include "dermis/image/io.h"
#include "dermis/mesh/uv_texels.h"
#include "dermis/rays/uv_raster.h"
#include "dermis/render/frame_values.h"
#include "dermis/scene/brdf_table.h"
#include "dermis/scene/cube_map.h"
#include "dermis/scene/prefilter.h"

namespace dermis::inline engines {
namespace {

using nlohmann::json;
using web::to_json;

constexpr int kVertexMapSize = 1024, kGutterTexels = 16, kShadowMapSize = 2048;
constexpr const char* kBends = "vertex_bends.exr";
constexpr const char* kOcclusion = "vertex_occlusion.png";
// A texel is 3 degrees wide, less than the lobes of skin.
constexpr int kReflectionLevels = 6, kReflectionTexels = 64;
constexpr int kReflectionPyramid = 128;  // texels along a side of the cube that is filtered

// The four pairs between the corners of a triangle.
std::array<Vec2, 4> between(const Mesh& mesh, const VertexNumbers& numbers, const UvTexel& texel) {
    const uint32_t* corner = &mesh.indices[3 * size_t(texel.triangle)];
    std::array<Vec2, 4> pairs;
    for (size_t i = 0; i < pairs.size(); ++i)
        pairs[i] = numbers[i][corner[0]] * (1 - texel.u - texel.v) + numbers[i][corner[1]] * texel.u +
                   numbers[i][corner[2]] * texel.v;
    return pairs;
}

// A camera at the light: without perspective where it is directional, else with the centre in its axis.
struct LightView {
    Vec3 x, y, to_light, center_mm;
    float radius_mm = 1;                // half of the map's side, measured at the centre
    float inverse_distance_per_mm = 0;  // 1 over the distance from the light to the centre; directional: 0

    // Column and row in texels, and what is linear between them: the magnification against the centre, or
    // without perspective how far towards the light, in mm.
    [[nodiscard]] Vec3 place(Vec3 p_mm) const {
        const Vec3 from = p_mm - center_mm;
        const float depth_mm = dot(from, to_light), larger = 1 / (1 - depth_mm * inverse_distance_per_mm);
        const float scale = kShadowMapSize / (2 * radius_mm) * larger;
        return {dot(from, x) * scale + kShadowMapSize / 2.0f, dot(from, y) * scale + kShadowMapSize / 2.0f,
                inverse_distance_per_mm > 0 ? larger : depth_mm};
    }
    [[nodiscard]] float depth_mm(float linear) const {
        return inverse_distance_per_mm > 0 ? (1 - 1 / linear) / inverse_distance_per_mm : linear;
    }
};

LightView light_view(const Scene& scene, const Light& light) {
    LightView view = {.center_mm = scene.bounds_center_mm, .radius_mm = scene.bounds_radius_mm};
    view.to_light = normalize(light.to_light_world);
    if (light.kind != LightKind::directional) {
        const Vec3 towards = light.position_mm - view.center_mm;
        const float distance_mm = length(towards);
        view.to_light = towards * (1 / distance_mm);
        view.inverse_distance_per_mm = 1 / distance_mm;
        view.radius_mm /= std::sqrt(1 - std::pow(view.radius_mm * view.inverse_distance_per_mm, 2.0f));
    }
    const Vec3 up = std::abs(view.to_light.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    view.x = normalize(cross(up, view.to_light));
    view.y = cross(view.to_light, view.x);
    return view;
}

void draw_depths(const Mesh& mesh, const Submesh& submesh, const LightView& view, Image& depths) {
    for (uint32_t t = submesh.first_index / 3; t < (submesh.first_index + submesh.index_count) / 3; ++t) {
        std::array<Vec3, 3> at;
        std::array<std::array<double, 2>, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            at[k] = view.place(mesh.positions_mm[mesh.indices[3 * size_t(t) + k]]);
            corners[k] = {at[k].x, at[k].y};
        }
        visit_texels_of(corners, {depths.width, depths.height}, [&](int x, int y, double v, double w) {
            const float depth = view.depth_mm(float((1 - v - w) * at[0].z + v * at[1].z + w * at[2].z));
            if (depth > depths.at(x, y, 0)) depths.set(x, y, 0, depth);
        });
    }
}

// The direction at x, z of an octahedral map (engines/common/reflections.glsl), each -1 to 1. Outside, which
// is the border, x and z wrap around the edge.
Vec3 octahedron_direction(float x, float z) {
    if (std::abs(x) > 1) {
        x = std::copysign(2 - std::abs(x), x);
        z = -z;
    }
    if (std::abs(z) > 1) {
        z = std::copysign(2 - std::abs(z), z);
        x = -x;
    }
    const float y = 1 - std::abs(x) - std::abs(z);
    if (y >= 0) return normalize({x, y, z});
    return normalize({std::copysign(1 - std::abs(z), x), y, std::copysign(1 - std::abs(x), z)});
}

}  // namespace

Result<void> add_picture(const std::string& name, const Image& image, std::vector<PackageFile>& files) {
    DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, encode_image(name.substr(name.rfind('.')), image));
    files.push_back({name, std::move(bytes)});
    return {};
}

Result<json> add_vertex_maps(const Scene& scene, std::span<const VertexNumbers> numbers,
                             std::vector<PackageFile>& files) {
    const UvRaster raster =
        rasterise_uv(scene.objects, kVertexMapSize, kVertexMapSize, is_skin, UvSet::atlas);
    Image bends(raster.width, raster.height, 4, PixelFormat::f16),
        occlusion(raster.width, raster.height, 3, PixelFormat::u8);
    for (int y = 0; y < raster.height; ++y)
        for (int x = 0; x < raster.width; ++x) {
            const UvTexel& texel = raster.texels[size_t(y) * size_t(raster.width) + size_t(x)];
            if (!texel.covered()) continue;
            const auto p = between(scene.objects[texel.object].mesh, numbers[texel.object], texel);
            const float bent[] = {p[0].x, p[0].y, p[1].x, p[3].x}, scattered[] = {p[1].y, p[2].x, p[2].y};
            for (int c = 0; c < 4; ++c) bends.set(x, y, c, bent[c]);
            for (int c = 0; c < 3; ++c) occlusion.set(x, y, c, scattered[c]);
        }
    const Image mask = coverage_mask(raster);
    dilate(bends, mask, kGutterTexels);
    dilate(occlusion, mask, kGutterTexels);
    DERMIS_TRY(add_picture(kBends, bends, files));
    DERMIS_TRY(add_picture(kOcclusion, occlusion, files));
    return json{{"bends", kBends}, {"occlusion", kOcclusion}};
}

bool can_have_shadow_map(const Scene& scene, const Light& light) {
    // The cone around the scene's sphere is then less than 150 degrees wide.
    return light.kind == LightKind::directional ||
           length(light.position_mm - scene.bounds_center_mm) >= 1.04f * scene.bounds_radius_mm;
}

Result<json> add_shadow_map(const Scene& scene, const Light& light, const std::string& name,
                            std::vector<PackageFile>& files) {
    const LightView view = light_view(scene, light);
    Image depths(kShadowMapSize, kShadowMapSize, 1, PixelFormat::f16);
    for (int row = 0; row < depths.height; ++row)
        for (int column = 0; column < depths.width; ++column)
            depths.set(column, row, 0, -2 * scene.bounds_radius_mm);  // behind all surfaces
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes) {
            const uint32_t m = submesh.material;
            const bool hidden = m < object.hidden.size() && object.hidden[m];
            if (!hidden && (m >= object.classes.size() || object.classes[m] != MaterialClass::translucent))
                draw_depths(object.mesh, submesh, view, depths);
        }
    DERMIS_TRY(add_picture(name, depths, files));
    return json{{"file", name},
                {"x", to_json(view.x)},
                {"y", to_json(view.y)},
                {"to_light", to_json(view.to_light)},
                {"center_mm", to_json(view.center_mm)},
                {"radius_mm", to_json(view.radius_mm)},
                {"inverse_distance_per_mm", to_json(view.inverse_distance_per_mm)}};
}

Result<void> add_reflected_shares(std::vector<PackageFile>& files) {
    DERMIS_TRY_ASSIGN(const BrdfTable table, BrdfTable::load());
    Image shares(kBrdfTableSize, kBrdfTableSize, 3, PixelFormat::f16);
    const auto centre = [](int i) { return (float(i) + 0.5f) / kBrdfTableSize; };
    for (int y = 0; y < shares.height; ++y)
        for (int x = 0; x < shares.width; ++x) {
            const Vec4 terms = table.at(kBrdfLobeGgx, centre(y), centre(x));
            shares.set(x, y, 0, terms.x);
            shares.set(x, y, 1, terms.y);
        }
    return add_picture(std::string(kReflectedShares), shares, files);
}

Result<json> add_reflections(const Environment& environment, const Image& panorama,
                             std::vector<PackageFile>& files) {
    const CubePyramid pyramid(panorama, kReflectionPyramid);
    constexpr int kSide = kReflectionTexels + 2;
    Image reflections(kSide, kSide * kReflectionLevels, 3, PixelFormat::f16);
    for (int level = 0; level < kReflectionLevels; ++level) {
        const PrefilteredLobe lobe(pyramid, float(level) / (kReflectionLevels - 1), prefilter_samples(level),
                                   4 * kPi / (kReflectionTexels * kReflectionTexels));
        parallel_for(kSide, 1, [&](size_t begin, size_t end) {
            for (size_t row = begin; row < end; ++row)
                for (int x = 0; x < kSide; ++x) {
                    const Vec3 d = octahedron_direction((float(x) - 0.5f) / kReflectionTexels * 2 - 1,
                                                        (float(row) - 0.5f) / kReflectionTexels * 2 - 1);
                    const Vec3 c =
                        lobe.reflected(to_environment(d, environment.yaw_rad)) * environment.intensity;
                    const int y = level * kSide + int(row);
                    reflections.set(x, y, 0, c.x);
                    reflections.set(x, y, 1, c.y);
                    reflections.set(x, y, 2, c.z);
                }
        });
    }
    DERMIS_TRY(add_picture(std::string(kReflections), reflections, files));
    return json{{"file", kReflections}, {"levels", kReflectionLevels}};
}

json ambient_terms(const EnvironmentLight& light, const Environment& environment) {
    // Lambert's bands over pi (Ramamoorthi, Hanrahan 2001).
    constexpr float kBands[] = {1, 2 / 3.0f, 2 / 3.0f, 2 / 3.0f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f};
    const std::array<Vec3, 9> terms = environment_terms(light.radiance_sh, environment.yaw_rad);
    json made = json::array();
    for (size_t i = 0; i < terms.size(); ++i)
        made.push_back(to_json(terms[i] * (kBands[i] * environment.intensity)));
    return made;
}

json box_json(const Mesh& mesh) {
    Vec3 low = mesh.positions_mm.front(), high = low;
    for (const Vec3& p : mesh.positions_mm) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return json::array({to_json(low), to_json(high)});
}

}  // namespace dermis::inline engines
