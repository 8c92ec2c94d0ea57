#include "dermis/rays/skin_texels.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/image/dilate.h"
#include "dermis/rays/flesh.h"
#include "dermis/rays/texture.h"
#include "dermis/rays/uv_raster.h"
#include "dermis/scene/atlas_mask.h"
#include "dermis/scene/image_source.h"

namespace dermis::inline rays {
namespace {

// As mean_normal_world() of shaders/include/surface.glsl.
Vec3 mean_normal(const Material& material, const Texture& map, const SurfaceAttributes& at) {
    const Vec3 n = at.n_geometry_world;
    if (map.empty()) return n;
    const Vec4 texel = map.sample(at.uv, at.footprint);
    const Vec3 mapped = Vec3{texel.x, texel.y, texel.z} * 2.0f - Vec3{1, 1, 1};
    if (material.normal_space == NormalSpace::object) return n + (mapped - n) * material.normal_scale;
    const Vec3 along{at.tangent_world.x, at.tangent_world.y, at.tangent_world.z};
    const Vec3 t = normalize(along - n * dot(n, along));
    if (dot(t, t) < 0.5f) return n;
    const Vec3 b = cross(n, t) * (at.tangent_world.w < 0 ? -1.0f : 1.0f);
    return t * (mapped.x * material.normal_scale) + b * (mapped.y * material.normal_scale) + n * mapped.z;
}

// As the renderer uploads a normal map: a texel whose length is not 1, as in a JPEG file, is no spread of
// normals.
void make_unit(Image& image) {
    image = to_linear_float(image);
    if (image.channels < 3) return;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        float* texel = &image.floats()[size_t(image.channels) * i];
        const Vec3 n = normalize(Vec3{texel[0], texel[1], texel[2]} * 2.0f - Vec3{1, 1, 1});
        texel[0] = n.x * 0.5f + 0.5f, texel[1] = n.y * 0.5f + 0.5f, texel[2] = n.z * 0.5f + 0.5f;
    }
}

// Square millimetres of a triangle over its area in UV.
float mm2_per_uv2(const Mesh& mesh, uint32_t triangle) {
    const uint32_t* corner = &mesh.indices[3 * size_t(triangle)];
    const Vec3 origin = mesh.positions_mm[corner[0]];
    const Vec2 uv = mesh.uvs[corner[0]], u = mesh.uvs[corner[1]] - uv, v = mesh.uvs[corner[2]] - uv;
    const float area = std::abs(u.x * v.y - u.y * v.x);
    return area > 0
               ? length(cross(mesh.positions_mm[corner[1]] - origin, mesh.positions_mm[corner[2]] - origin)) /
                     area
               : 0;
}

}  // namespace

struct SkinTexelReader::Impl {
    const Scene* scene;
    std::vector<Flesh> flesh;
    RayScene rays;
    std::vector<std::vector<Texture>> normal_maps;  // of each object and material; empty: none
};

SkinTexelReader::SkinTexelReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SkinTexelReader::~SkinTexelReader() = default;
SkinTexelReader::SkinTexelReader(SkinTexelReader&&) noexcept = default;

Result<SkinTexelReader> SkinTexelReader::create(const Scene& scene) {
    DERMIS_TRY_ASSIGN(std::vector<Flesh> flesh, find_flesh(scene.objects));
    DERMIS_TRY_ASSIGN(RayScene rays, RayScene::build(scene.objects));
    std::vector<std::vector<Texture>> maps;
    for (const SceneObject& object : scene.objects) {
        auto& of_object = maps.emplace_back(object.mesh.materials.size());
        for (size_t i = 0; i < of_object.size(); ++i) {
            const Material& material = object.mesh.materials[i];
            if (object.classes[i] != MaterialClass::skin || !material.normal_map.present()) continue;
            DERMIS_TRY_ASSIGN(Image image, load_image_source(material.normal_map, ImageUse::data));
            if (material.dilate_texels > 0)
                dilate(image, atlas_mask(object.mesh, image.width, image.height), material.dilate_texels);
            make_unit(image);
            of_object[i] = Texture(image, material.normal_map.wrap_u, material.normal_map.wrap_v);
        }
    }
    return SkinTexelReader(
        std::make_unique<Impl>(Impl{&scene, std::move(flesh), std::move(rays), std::move(maps)}));
}

SkinTexels SkinTexelReader::read(int size) const {
    const UvRaster raster = rasterise_uv(impl_->scene->objects, size, size);
    SkinTexels skin{.size = size, .texels = {}, .coverage = coverage_mask(raster)};
    for (size_t i = 0; i < raster.texels.size(); ++i)
        if (raster.texels[i].covered()) skin.texels.push_back({.index = uint32_t(i)});
    parallel_for(skin.texels.size(), 1024, [&](size_t begin, size_t end) {
        for (SkinTexel& texel : std::span(skin.texels).subspan(begin, end - begin)) {
            const UvTexel& place = raster.texels[texel.index];
            const Mesh& mesh = impl_->scene->objects[place.object].mesh;
            SurfaceAttributes at = impl_->rays.surface_at(place.as_hit(face_normal(mesh, place.triangle)));
            at.footprint = {{1 / float(size), 0}, {0, 1 / float(size)}};
            texel.p_mm = at.p_world_mm;
            texel.n_geometry = at.n_geometry_world;
            texel.n =
                mean_normal(mesh.materials[at.material], impl_->normal_maps[place.object][at.material], at);
            const bool seen = impl_->flesh[place.object].faces[place.triangle] == SkinFace::visible;
            texel.area_mm2 = seen ? mm2_per_uv2(mesh, place.triangle) / (float(size) * float(size)) : 0;
        }
    });
    return skin;
}

float typical_texel_mm(const SkinTexels& skin) {
    std::vector<float> areas;
    double total = 0, sum = 0;
    for (const SkinTexel& texel : skin.texels) areas.push_back(texel.area_mm2), total += texel.area_mm2;
    std::ranges::sort(areas);
    for (const float area : areas)
        if ((sum += area) >= 0.5 * total) return std::sqrt(area);
    return 0;
}

}  // namespace dermis::inline rays
