#include "dermis/rays/bake_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/parallel.h"
#include "dermis/base/text.h"
#include "dermis/image/dilate.h"
#include "dermis/image/resample.h"
#include "dermis/mesh/curvature.h"
#include "dermis/mesh/uv_report.h"
#include "dermis/optics/conversions.h"
#include "dermis/rays/random.h"
#include "dermis/rays/sampling.h"
#include "dermis/rays/uv_raster.h"
#include "dermis/rays/vertex_gain.h"
#include "dermis/rays/vertex_occlusion.h"
#include "dermis/scene/skin_atlas.h"

namespace dermis::inline rays {
namespace {

constexpr float kMostKernelSize = 254.0f / 255;
constexpr double kOverlapWorthSaying = 0.001;

using Progress01 = std::function<void(double)>;

MaterialFilter filter_of(const BakeMapSettings& settings) {
    if (!settings.material) return is_skin;
    return [name = *settings.material](const SceneObject& object, uint32_t material) {
        return material < object.mesh.materials.size() && object.mesh.materials[material].name == name;
    };
}

// The tensor at a texel in the frame that shaders make of interpolated normal and tangent (surface.glsl).
Vec3 curvature_in_tangents(const Mesh& mesh, const std::vector<CurvatureTensor>& tensors,
                           const UvTexel& texel) {
    const uint32_t* corner = &mesh.indices[3 * size_t(texel.triangle)];
    const float weight[3] = {1 - texel.u - texel.v, texel.u, texel.v};
    CurvatureTensor s;
    Vec3 n, along;
    float side = 1;
    for (int k = 0; k < 3; ++k) {
        const Vec4 t = mesh.tangents.empty() ? Vec4{1, 0, 0, 1} : mesh.tangents[corner[k]];
        s.diagonal += tensors[corner[k]].diagonal * weight[k];
        s.mixed += tensors[corner[k]].mixed * weight[k];
        n += mesh.normals[corner[k]] * weight[k];
        along += Vec3{t.x, t.y, t.z} * weight[k];
        side = t.w;
    }
    n = normalize(n);
    along -= n * dot(n, along);
    const Vec3 t = dot(along, along) > 1e-12f ? normalize(along) : frame_of(n).tangent;
    const Vec3 b = cross(n, t) * side;
    const float tt = dot(t, s * t), bb = dot(b, s * b);
    return {(tt + bb) / 2, (tt - bb) / 2, dot(t, s * b)};
}

Image curvature_values(std::span<const SceneObject> objects, const UvRaster& raster, double smoothing_mm) {
    std::vector<std::vector<CurvatureTensor>> tensors;
    for (const SceneObject& object : objects)
        tensors.push_back(compute_curvature_tensors(object.mesh, smoothing_mm));
    Image image(raster.width, raster.width, 3);
    const std::span<float> values = image.floats();
    for (size_t i = 0; i < raster.texels.size(); ++i) {
        const UvTexel& t = raster.texels[i];
        if (!t.covered()) continue;
        const Vec3 value = curvature_in_tangents(objects[t.object].mesh, tensors[t.object], t);
        values[3 * i] = value.x;
        values[3 * i + 1] = value.y;
        values[3 * i + 2] = value.z;
    }
    return image;
}

// The coefficients of the metric are interpolated, not the lengths: they are linear.
Image stretch_values(std::span<const SceneObject> objects, const UvRaster& raster, UvSet uvs) {
    std::vector<std::vector<UvMetric>> metrics;
    for (const SceneObject& object : objects) {
        const bool on_atlas = uvs == UvSet::atlas && !object.mesh.atlas_uvs.empty();
        if (!on_atlas && object.mesh.uvs.empty())
            metrics.emplace_back();
        else
            metrics.push_back(vertex_uv_metrics(on_atlas ? over_atlas(object.mesh) : object.mesh));
    }
    Image image(raster.width, raster.width, 3);
    const std::span<float> values = image.floats();
    for (size_t i = 0; i < raster.texels.size(); ++i) {
        const UvTexel& t = raster.texels[i];
        if (!t.covered()) continue;
        const uint32_t* corner = &objects[t.object].mesh.indices[3 * size_t(t.triangle)];
        const float weight[3] = {1 - t.u - t.v, t.u, t.v};
        UvMetric sum;
        for (int k = 0; k < 3; ++k) {
            const UvMetric& m = metrics[t.object][corner[k]];
            sum.e_mm2 += m.e_mm2 * weight[k];
            sum.f_mm2 += m.f_mm2 * weight[k];
            sum.g_mm2 += m.g_mm2 * weight[k];
        }
        values[3 * i] = sum.mm_per_u();
        values[3 * i + 1] = sum.mm_per_v();
        const float product = sum.mm_per_u() * sum.mm_per_v();
        values[3 * i + 2] = product > 0 ? std::clamp(sum.f_mm2 / product, -1.0f, 1.0f) : 0;
    }
    return image;
}

Result<Image> gain_values(std::span<const SceneObject> objects, const UvRaster& raster,
                          const BakeMapSettings& settings, BakedMap& map) {
    DERMIS_TRY_ASSIGN(const VertexGains walked, walk_vertex_gains(objects, walk_medium_of(*settings.profile),
                                                                  {.walks_per_mm2 = settings.walks_per_mm2}));
    map.noise = walked.noise;
    Image image(raster.width, raster.width, 3);
    for (size_t i = 0; i < raster.texels.size(); ++i) {
        const UvTexel& t = raster.texels[i];
        if (!t.covered()) continue;
        const uint32_t* corner = &objects[t.object].mesh.indices[3 * size_t(t.triangle)];
        const std::vector<Vec3>& gains = walked.gains[t.object];
        const Vec3 value =
            gains[corner[0]] * (1 - t.u - t.v) + gains[corner[1]] * t.u + gains[corner[2]] * t.v;
        std::ranges::copy(std::array{value.x, value.y, value.z}, &image.floats()[3 * i]);
    }
    return image;
}

struct Depth {
    float sum_mm = 0;
    int found = 0;
};

Depth inward_depth(const RayScene& rays, const SurfaceAttributes& surface, uint32_t seed,
                   const BakeMapSettings& settings) {
    const LocalFrame frame = frame_of(-surface.n_geometry_world);
    // Cosine-weighted within the cone: a disk sample of the hemisphere, scaled by the cone's sine.
    const float sine = std::sin(settings.cone_rad), least_mm = 10 * rays.epsilon_mm();
    Depth depth;
    for (int i = 0; i < settings.rays; ++i) {
        const Vec2 p = sample_disk(OwenSequence(seed, uint32_t(i)).next_2d()) * sine;
        const float cosine = std::sqrt(std::max(0.0f, 1 - dot(p, p)));
        const Vec3 direction = frame.to_world({p.x, p.y, cosine});
        if (dot(direction, surface.n_face_world) >= 0) continue;
        const auto hit = rays.closest_hit(
            RaySet::opaque, {.origin_mm = surface.p_world_mm, .direction = direction, .min_mm = least_mm});
        if (!hit) continue;  // from either side: slivers have no reliable normal
        depth.sum_mm += std::min(hit->distance_mm * cosine, settings.max_mm);
        ++depth.found;
    }
    return depth;
}

// One value per covered texel of a grid that is no finer than needed.
template <class Value>
void trace_texels(const UvRaster& raster, const RayScene& rays, Image& image, const Progress01& progress,
                  Value value) {
    const std::span<float> values = image.floats();
    std::atomic<int> rows = 0;
    parallel_for(size_t(raster.width), 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            for (size_t i = y * size_t(raster.width); i < (y + 1) * size_t(raster.width); ++i) {
                const UvTexel& texel = raster.texels[i];
                if (!texel.covered()) continue;
                const Vec3 n_face = face_normal(rays.mesh(texel.object), texel.triangle);
                SurfaceAttributes surface = rays.surface_at(texel.as_hit(n_face));
                // A triangle can have an area in UV but none in space, as at the poles of a globe.
                if (surface.n_face_world == Vec3{}) surface.n_face_world = surface.n_geometry_world;
                values[i] = value(surface, hash_u32(uint32_t(i)));
            }
            if (progress) progress(double(++rows) / raster.width);
        }
    });
}

// From the coarse grid to the map: islands grow first, so that no background is mixed in at their edges.
Image enlarged(Image coarse, const UvRaster& coarse_raster, const UvRaster& raster) {
    if (coarse_raster.width == raster.width) return coarse;
    dilate(coarse, coverage_mask(coarse_raster), 8);
    Image image(raster.width, raster.width, 1);
    const std::span<float> values = image.floats();
    for (size_t i = 0; i < raster.texels.size(); ++i) {
        if (!raster.texels[i].covered()) continue;
        const Vec2 uv{(float(i % size_t(raster.width)) + 0.5f) / float(raster.width),
                      (float(i / size_t(raster.width)) + 0.5f) / float(raster.width)};
        values[i] = sample_bilinear(coarse, uv).x;
    }
    return image;
}

Result<Image> traced_values(std::span<const SceneObject> objects, const UvRaster& raster,
                            const BakeMapSettings& settings, const Progress01& progress, BakedMap& map) {
    Result<RayScene> rays = RayScene::build(objects);
    if (!rays) return rays.error();
    const bool occlusion = settings.kind == MapKind::occlusion;
    const UvRaster own =
        settings.size > settings.ray_size
            ? rasterise_uv(objects, settings.ray_size, settings.ray_size, filter_of(settings), settings.uvs)
            : UvRaster{};
    const UvRaster& coarse = own.width > 0 ? own : raster;
    Image image(coarse.width, coarse.width, 1);
    std::atomic<size_t> found = 0, empty = 0;
    const OcclusionSettings sky{.rays = settings.rays,
                                .max_mm = settings.max_mm > 0 ? settings.max_mm : 1e30f};
    trace_texels(coarse, *rays, image, progress, [&](const SurfaceAttributes& surface, uint32_t seed) {
        if (occlusion)
            return point_occlusion(*rays, surface.p_smooth_mm, surface.n_geometry_world, seed, sky);
        const Depth depth = inward_depth(*rays, surface, seed, settings);
        depth.found > 0 ? ++found : ++empty;
        return depth.found > 0 ? depth.sum_mm / float(depth.found) : settings.max_mm;
    });
    if (empty > 0 && double(empty) > 1e-3 * double(found + empty))
        map.warnings.push_back(
            to_text(std::round(1000.0 * double(empty) / double(found + empty)) / 10) +
            " % of the surface has no opposite side (the mesh is open); its thickness is set to " +
            to_text(settings.max_mm) + " mm");
    return enlarged(std::move(image), coarse, raster);
}

Result<void> check_settings(const BakeMapSettings& s) {
    const auto wrong = [](std::string_view what, double value, std::string_view range) {
        return Error{std::string(what) + " is " + to_text(value) + ", not within " + std::string(range)};
    };
    if (s.size < 16 || s.size > kMaxImageSide) return wrong("map size", s.size, "16..16384");
    if (s.gutter_texels < 0 || s.gutter_texels > 256)
        return wrong("gutter", s.gutter_texels, "0..256 texels");
    if (s.rays < 1 || s.rays > 4096) return wrong("rays", s.rays, "1..4096");
    if (s.ray_size < 16) return wrong("ray size", s.ray_size, "16..16384");
    if (!(s.smoothing_mm >= 0 && s.smoothing_mm <= 100))
        return wrong("smoothing_mm", s.smoothing_mm, "0..100");
    if (!(s.cone_rad >= 0 && s.cone_rad <= 1.5f)) return wrong("cone_rad", s.cone_rad, "0..1.5");
    if (!(s.max_mm >= 0 && s.max_mm <= 1e6f)) return wrong("max_mm", s.max_mm, "0..1000000");
    if ((s.kind == MapKind::kernel_size || s.kind == MapKind::gain) && !s.profile)
        return Error{std::string(map_kind_name(s.kind)) + " needs a diffusion profile"};
    return {};
}

Result<void> check_raster(std::span<const SceneObject> objects, const UvRaster& raster,
                          const BakeMapSettings& settings, BakedMap& map) {
    if (raster.covered == 0) {
        if (settings.material) {
            std::vector<std::string> names;
            for (const SceneObject& object : objects)
                for (const Material& material : object.mesh.materials) names.push_back(material.name);
            if (std::ranges::find(names, *settings.material) == names.end())
                return Error{unknown_name("material", *settings.material, names)};
        }
        return Error{"there is nothing to bake: no skin triangle has UVs within 0..1 that cover a texel"};
    }
    if (double(raster.overlapping) > kOverlapWorthSaying * double(raster.covered))
        map.warnings.push_back(
            to_text(std::round(1000.0 * double(raster.overlapping) / double(raster.covered)) / 10) +
            " % of the map is covered by more than one triangle; the last one is used (choose a material)");
    if (raster.outside > 0)
        map.warnings.push_back(std::to_string(raster.outside) +
                               " triangles have UVs outside 0..1 and are left out");
    return {};
}

void measure_range(const UvRaster& raster, BakedMap& map) {
    map.min = std::numeric_limits<float>::max();
    map.max = std::numeric_limits<float>::lowest();
    const std::span<const float> values = std::as_const(map.values).floats();
    for (size_t i = 0; i < raster.texels.size(); ++i) {
        if (!raster.texels[i].covered()) continue;
        const float value = values[i * size_t(map.values.channels)];
        map.min = std::min(map.min, value);
        map.max = std::max(map.max, value);
    }
}

}  // namespace

std::string_view map_kind_name(MapKind kind) {
    switch (kind) {
        case MapKind::curvature:
            return "curvature";
        case MapKind::thickness:
            return "thickness";
        case MapKind::kernel_size:
            return "kernel-size";
        case MapKind::stretch:
            return "stretch";
        case MapKind::occlusion:
            return "occlusion";
        case MapKind::gain:
            return "gain";
    }
    return "curvature";
}

float spread_radius_mm(const Profile& profile) {
    double spread_mm = 0;
    for (int c = 0; c < 3; ++c)
        if (diffuse_albedo(profile, c) > 0) spread_mm = std::max(spread_mm, inverse_cdf_mm(profile, c, 0.95));
    return float(spread_mm);
}

float kernel_size_of_thickness(float spread_mm, float thickness_mm) {
    return std::min(spread_mm / (spread_mm + std::max(thickness_mm, 0.0f)), kMostKernelSize);
}

Result<BakedMap> bake_map(std::span<const SceneObject> objects, const BakeMapSettings& settings,
                          const std::function<void(double)>& progress) {
    DERMIS_TRY(check_settings(settings));
    const UvRaster raster =
        rasterise_uv(objects, settings.size, settings.size, filter_of(settings), settings.uvs);
    BakedMap map{.kind = settings.kind, .coverage = coverage_mask(raster)};
    DERMIS_TRY(check_raster(objects, raster, settings, map));
    switch (settings.kind) {
        case MapKind::curvature:
            map.values = curvature_values(objects, raster, settings.smoothing_mm);
            map.unit = "1/mm";
            break;
        case MapKind::stretch:
            map.values = stretch_values(objects, raster, settings.uvs);
            map.unit = "mm per unit of u, mm per unit of v, cosine";
            break;
        case MapKind::gain: {
            DERMIS_TRY_ASSIGN(map.values, gain_values(objects, raster, settings, map));
            map.unit = "1";
            break;
        }
        default: {
            Result<Image> values = traced_values(objects, raster, settings, progress, map);
            if (!values) return values.error();
            map.values = std::move(*values);
            map.unit = settings.kind == MapKind::thickness ? "mm" : "1";
        }
    }
    if (settings.kind == MapKind::kernel_size) {
        const float spread_mm = spread_radius_mm(*settings.profile);
        for (size_t i = 0; i < raster.texels.size(); ++i)
            if (raster.texels[i].covered())
                map.values.floats()[i] = kernel_size_of_thickness(spread_mm, map.values.floats()[i]);
    }
    measure_range(raster, map);
    dilate(map.values, map.coverage, settings.gutter_texels);
    return map;
}

}  // namespace dermis::inline rays
