#include "dermis/reference/materials.h"

#include <algorithm>

#include "dermis/base/hash.h"
#include "dermis/image/dilate.h"
#include "dermis/optics/fresnel.h"
#include "dermis/rays/mapped_normal.h"
#include "dermis/rays/uv_raster.h"
#include "dermis/scene/image_source.h"

namespace dermis::inline reference {
namespace {

// The renderer's minimum of the roughness too: at 0 a highlight would be a point.
constexpr float kLeastRoughness = 0.03f;

Vec3 rgb(Vec4 v) {
    return {v.x, v.y, v.z};
}

// A factor that glTF stores in alpha and other formats in red.
float factor(const Texture& map, const SurfaceAttributes& surface) {
    const Vec4 value = map.sample(surface.uv, surface.footprint);
    return map.channels() == 4 ? value.w : value.x;
}

Vec3 tangent_space_normal(Vec3 mapped, const SurfaceAttributes& surface) {
    const Vec3 n = surface.n_geometry_world, along = rgb(surface.tangent_world);
    const Vec3 t = normalize(along - n * dot(n, along));
    if (dot(t, t) < 0.5f) return n;
    const Vec3 b = cross(n, t) * (surface.tangent_world.w < 0 ? -1.0f : 1.0f);
    return normalize(t * mapped.x + b * mapped.y + n * mapped.z);
}

}  // namespace

Result<const Texture*> MaterialSet::texture_of(const ImageSource& source, ImageUse use,
                                               const SceneObject& object, const Material& material) {
    if (!source.present()) return static_cast<const Texture*>(nullptr);
    const int gutter = material.dilate_texels;
    const std::string key = Hasher()
                                .add(source.name)
                                .add(source.encoded)
                                .add(use)
                                .add(gutter)
                                .add(source.wrap_u)
                                .add(source.wrap_v)
                                .hex();
    std::unique_ptr<Texture>& texture = textures_[key];
    if (!texture) {
        DERMIS_TRY_ASSIGN(Image loaded, load_image_source(source, use));
        Image& image = loaded;
        const auto every = [](const SceneObject&, uint32_t) { return true; };
        if (gutter > 0)
            dilate(image,
                   coverage_mask(rasterise_uv(std::span(&object, 1), image.width, image.height, every)),
                   gutter);
        texture = std::make_unique<Texture>(image, source.wrap_u, source.wrap_v);
    }
    return static_cast<const Texture*>(texture.get());
}

Result<MaterialSet> MaterialSet::load(const Scene& scene) {
    struct Slot {
        ImageSource Material::*source;
        const Texture* Maps::*map;
        ImageUse use;
    };
    static const Slot kSlots[] = {
        {&Material::base_color_map, &Maps::base_color, ImageUse::color},
        {&Material::normal_map, &Maps::normal, ImageUse::data},
        {&Material::wrinkle_stretch_map, &Maps::wrinkle_stretch, ImageUse::data},
        {&Material::wrinkle_compress_map, &Maps::wrinkle_compress, ImageUse::data},
        {&Material::specular_map, &Maps::specular, ImageUse::data},
        {&Material::roughness_map, &Maps::roughness, ImageUse::data},
        {&Material::metallic_map, &Maps::metallic, ImageUse::data},
        {&Material::metallic_roughness_map, &Maps::metallic_roughness, ImageUse::data},
        {&Material::occlusion_map, &Maps::occlusion, ImageUse::data},
        {&Material::opacity_map, &Maps::opacity, ImageUse::color},
        {&Material::emission_map, &Maps::emission, ImageUse::color},
        {&Material::scatter_map, &Maps::scatter, ImageUse::data}};
    MaterialSet set;
    set.scene_ = &scene;
    for (const SceneObject& object : scene.objects) {
        std::vector<Entry>& entries = set.objects_.emplace_back();
        for (size_t i = 0; i < object.mesh.materials.size(); ++i) {
            Entry entry{.material = &object.mesh.materials[i]};
            entry.wrinkle_weights = wrinkle_weights(*entry.material, object.target_weights);
            if (i < object.classes.size()) entry.material_class = object.classes[i];
            for (const Slot& slot : kSlots) {
                DERMIS_TRY_ASSIGN(const Texture* texture, set.texture_of(entry.material->*slot.source,
                                                                         slot.use, object, *entry.material));
                entry.maps.*slot.map = texture;
            }
            entries.push_back(entry);
        }
    }
    return set;
}

const MaterialSet::Entry& MaterialSet::entry(const SurfaceAttributes& surface, uint32_t object) const {
    return objects_[object][surface.material];
}

Vec3 MaterialSet::normal_at(const SurfaceAttributes& surface, uint32_t object) const {
    const Entry& e = entry(surface, object);
    const Vec3 n = surface.n_geometry_world;
    if (!e.maps.normal) return n;
    Vec3 mapped = mapped_normal(*e.material,
                                {.normal = e.maps.normal,
                                 .stretch = e.maps.wrinkle_stretch,
                                 .compress = e.maps.wrinkle_compress,
                                 .weights = e.wrinkle_weights},
                                surface);
    const float scale = e.material->normal_scale;
    if (e.material->normal_space == NormalSpace::object) return normalize(n + (mapped - n) * scale);
    mapped.x *= scale;
    mapped.y *= scale;
    return tangent_space_normal(mapped, surface);
}

Vec3 MaterialSet::transmittance_at(const SurfaceAttributes& surface, uint32_t object) const {
    const Entry& e = entry(surface, object);
    if (e.maps.opacity) return rgb(e.maps.opacity->sample(surface.uv, surface.footprint));
    return e.material->base_color_linear * (1 - e.material->opacity);
}

float MaterialSet::occlusion_at(const SurfaceAttributes& surface, const RayHit& hit) const {
    const Entry& e = entry(surface, hit.object);
    const Mesh& mesh = scene_->objects[hit.object].mesh;
    float occlusion = 1;
    if (!mesh.occlusions.empty()) {
        const uint32_t* corner = &mesh.indices[3 * size_t(hit.triangle)];
        occlusion = mesh.occlusions[corner[0]] * (1 - hit.u - hit.v) + mesh.occlusions[corner[1]] * hit.u +
                    mesh.occlusions[corner[2]] * hit.v;
    }
    // Both are of the same shape: the darker one counts, not both (shaders/include/surface.glsl).
    return e.maps.occlusion ? std::min(occlusion, e.maps.occlusion->sample(surface.uv, surface.footprint).x)
                            : occlusion;
}

SurfaceReflection MaterialSet::reflection_at(const SurfaceAttributes& surface, uint32_t object) const {
    const Entry& e = entry(surface, object);
    const Material& material = *e.material;
    const Maps& maps = e.maps;
    SurfaceReflection made{material.roughness, float(f0_of_eta(material.ior)) * material.specular};
    if (maps.specular) made.f0 *= factor(*maps.specular, surface);
    if (maps.roughness)
        made.roughness *= maps.roughness->sample(surface.uv, surface.footprint).x;
    else if (maps.metallic_roughness)
        made.roughness *= maps.metallic_roughness->sample(surface.uv, surface.footprint).y;
    made.roughness = std::clamp(made.roughness, kLeastRoughness, 1.0f);
    return made;
}

ShadingPoint MaterialSet::shade(const SurfaceAttributes& surface, const RayHit& hit) const {
    const Entry& e = entry(surface, hit.object);
    const Material& material = *e.material;
    const bool is_skin = e.material_class == MaterialClass::skin;
    const SurfaceReflection reflection = reflection_at(surface, hit.object);
    ShadingPoint point{.p_mm = surface.p_world_mm,
                       .p_smooth_mm = surface.p_smooth_mm,
                       .n_face = surface.n_face_world,
                       .n_geometry = surface.n_geometry_world,
                       .n = normal_at(surface, hit.object),
                       .albedo_linear = material.base_color_linear * rgb(surface.color_linear),
                       .emission_linear = material.emission_linear,
                       .roughness = reflection.roughness,
                       .f0 = reflection.f0,
                       .metallic = is_skin ? 0 : material.metallic,
                       .opacity = e.material_class == MaterialClass::translucent ? material.opacity : 1,
                       .occlusion = occlusion_at(surface, hit),
                       .material_class = e.material_class,
                       .scatter = material.scatter,
                       .object = hit.object,
                       .material = surface.material};
    if (e.maps.scatter) point.scatter *= e.maps.scatter->sample(surface.uv, surface.footprint).x;
    if (is_skin) point.albedo_linear = point.albedo_linear * scene_->skin.albedo_tint_linear;
    if (e.maps.base_color)
        point.albedo_linear =
            point.albedo_linear * rgb(e.maps.base_color->sample(surface.uv, surface.footprint));
    if (e.maps.emission)
        point.emission_linear =
            point.emission_linear * rgb(e.maps.emission->sample(surface.uv, surface.footprint));
    if (e.maps.metallic)
        point.metallic *= e.maps.metallic->sample(surface.uv, surface.footprint).x;
    else if (e.maps.metallic_roughness)
        point.metallic *= e.maps.metallic_roughness->sample(surface.uv, surface.footprint).z;
    return point;
}

}  // namespace dermis::inline reference
