#include "dermis/render/scene_upload.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/mesh/uv_report.h"
#include "dermis/rays/carried_bakes.h"
#include "dermis/render/complete_scene.h"
#include "dermis/render/material_maps.h"
#include "dermis/render/seam_textures.h"
#include "dermis/scene/object_checks.h"
#include "dermis/scene/skin_atlas.h"
#include "dermis/scene/wrinkles.h"
#include "shaders/include/constants.h"

namespace dermis::inline render {
namespace {

// One texture for each image and use, even if several materials name it.
std::string texture_key(const MaterialMap& map, const Material& material) {
    const ImageSource* source = map_source(map, material);
    if (!source) return map.texture;
    Hasher hasher;
    hasher.add(map.texture).add(material.dilate_texels);
    for (const ImageSource* one : {source, map.second_layer ? &(material.*map.second_layer) : nullptr})
        if (one) hasher.add(one->name).add(one->encoded).add(one->wrap_u).add(one->wrap_v);
    return hasher.hex();
}

std::span<const float> floats_of(const auto& attribute) {
    using Element = typename std::remove_cvref_t<decltype(attribute)>::value_type;
    return {reinterpret_cast<const float*>(attribute.data()),
            attribute.size() * sizeof(Element) / sizeof(float)};
}

// Missing attributes get neutral values.
template <class T>
std::vector<T> filled(const std::vector<T>& attribute, size_t count, T neutral) {
    return attribute.size() == count ? attribute : std::vector<T>(count, neutral);
}

// Attributes that move with the vertices, complete, and as streams.
struct MovingStreams {
    std::vector<Vec3> normals, diagonals, mixed, du_mm, dv_mm;
    std::vector<Vec4> tangents;
    std::vector<gpu::VertexStream> streams;

    // `rest`: the mesh in its rest pose, null unless bakes of it are asked for.
    MovingStreams(const Mesh& mesh, const Mesh* rest, const RestBakes& rest_bakes) {
        const size_t count = mesh.positions_mm.size();
        normals = filled(mesh.normals, count, Vec3{0, 0, 1});
        tangents = filled(mesh.tangents, count, Vec4{1, 0, 0, 1});
        const std::vector<CurvatureTensor> curvatures =
            rest && rest_bakes.curvature  ? carried_curvatures(*rest, mesh)
            : rest && rest_bakes.stencils ? followed_curvatures(*rest, mesh)
                                          : mesh.curvatures_per_mm;
        for (const CurvatureTensor& tensor : filled(curvatures, count, CurvatureTensor{})) {
            diagonals.push_back(tensor.diagonal);
            mixed.push_back(tensor.mixed);
        }
        const UvDerivatives derivatives =
            atlas_uvs_of(mesh).size() == count ? vertex_uv_derivatives(over_atlas(mesh)) : UvDerivatives{};
        du_mm = filled(derivatives.du_mm, count, Vec3{});
        dv_mm = filled(derivatives.dv_mm, count, Vec3{});
        streams = {{"position_mm", 3, floats_of(mesh.positions_mm)},
                   {"normal", 3, floats_of(normals)},
                   {"tangent", 4, floats_of(tangents)},
                   {"curvature_diagonal_per_mm", 3, floats_of(diagonals)},
                   {"curvature_mixed_per_mm", 3, floats_of(mixed)},
                   {"du_mm", 3, floats_of(du_mm)},
                   {"dv_mm", 3, floats_of(dv_mm)}};
    }
    MovingStreams(const MovingStreams&) = delete;
    MovingStreams& operator=(const MovingStreams&) = delete;
};

const Mesh* rest_mesh(const Scene& scene, size_t object) {
    return scene.rest_objects.empty() ? nullptr : &scene.rest_objects[object].mesh;
}

Result<gpu::Geometry> upload_mesh(gpu::Device& device, std::string_view name, const Mesh& mesh,
                                  const Mesh* rest, const RestBakes& rest_bakes) {
    const size_t count = mesh.positions_mm.size();
    const MovingStreams moving(mesh, rest, rest_bakes);
    const auto uvs = filled(mesh.uvs, count, Vec2{});
    const auto atlas_uvs = filled(atlas_uvs_of(mesh), count, Vec2{});
    const auto colors = filled(mesh.colors_linear, count, Vec4{1, 1, 1, 1});
    const Mesh& occluded = rest && rest_bakes.occlusion ? *rest : mesh;
    const auto occlusions = filled(occluded.occlusions, count, 1.0f);
    const Result<std::vector<Vec3>> occlusions_blurred = blurred_occlusions(occluded);
    if (!occlusions_blurred) return Error{std::string(name) + ": " + occlusions_blurred.error().message};
    const std::vector<Vec3> no_gain(count, Vec3{1, 1, 1});
    std::vector<gpu::VertexStream> streams = moving.streams;
    streams.insert(streams.end(), {{"uv", 2, floats_of(uvs)},
                                   {"atlas_uv", 2, floats_of(atlas_uvs)},
                                   {"occlusion", 1, occlusions},
                                   {"occlusion_blurred", 3, floats_of(*occlusions_blurred)},
                                   {"walked_gain", 3, floats_of(no_gain)},
                                   {"color_linear", 4, floats_of(colors)}});
    return gpu::Geometry::upload(device, name, streams, mesh.indices);
}

int32_t has_wrinkle_map(const Material& material) {
    return (material.wrinkle_stretch_map.present() ? kWrinkleStretch : 0) |
           (material.wrinkle_compress_map.present() ? kWrinkleCompress : 0);
}

float dielectric_f0(float ior) {
    const float r = (ior - 1) / (ior + 1);
    return r * r;
}

void add_wrinkle_weights(const Material& material, const TargetWeights& targets, gpu::Values& values) {
    const WrinkleWeights weights = wrinkle_weights(material, targets);
    values["wrinkle_stretch_weight"] = weights.stretch;
    values["wrinkle_compress_weight"] = weights.compress;
}

std::vector<TargetWeights> target_weights_of(const Scene& scene) {
    std::vector<TargetWeights> weights;
    for (const SceneObject& object : scene.objects) weights.push_back(object.target_weights);
    return weights;
}

// The block Material of shaders/include/surface.glsl, but for the weights of the wrinkle maps.
gpu::Values material_values(const Material& material, MaterialClass material_class, const Skin& skin) {
    const bool is_skin = material_class == MaterialClass::skin;
    const Vec3 tint = is_skin ? skin.albedo_tint_linear : Vec3{1, 1, 1};
    const float cutoff = material_class == MaterialClass::other ? cutoff_of_map(material) : 0;
    int32_t normal_space = kNormalSpaceAbsent;
    if (material.normal_map.present())
        normal_space =
            material.normal_space == NormalSpace::object ? kNormalSpaceObject : kNormalSpaceTangent;
    return {{"albedo_linear", material.base_color_linear * tint},
            {"roughness", material.roughness},
            {"emission_linear", material.emission_linear},
            {"emission_from_map", int32_t(material.emission_map.present())},
            {"specular", material.specular},
            {"f0", dielectric_f0(material.ior)},
            {"metallic", material.metallic},
            {"opacity", material.alpha_mode == AlphaMode::mask ? 1.0f : material.opacity},
            {"alpha_cutoff", cutoff},
            {"normal_space", normal_space},
            {"normal_scale", material.normal_scale},
            {"opacity_from_map", int32_t(material.opacity_map.present())},
            {"scatter", material.scatter},
            {"has_wrinkle_map", has_wrinkle_map(material)},
            {"wrinkle_from", material.wrinkle_from},
            {"wrinkle_full", material.wrinkle_full},
            {"curvature_scale_per_mm", material.curvature_scale_per_mm},
            {"curvature_mid", material.curvature_mid}};
}

gpu::DrawClass draw_class(const Material& material, MaterialClass material_class) {
    switch (material_class) {
        case MaterialClass::skin:
            return gpu::DrawClass::skin;
        case MaterialClass::other:
            return is_blended(material) ? gpu::DrawClass::blended : gpu::DrawClass::other;
        case MaterialClass::translucent:
            return gpu::DrawClass::translucent;
    }
    return gpu::DrawClass::other;
}

}  // namespace

bool SceneOnDevice::has(gpu::DrawClass wanted) const {
    return std::ranges::any_of(draws_, [&](const gpu::Draw& draw) { return draw.draw_class == wanted; });
}

// Decoding takes most of the time, so all maps are decoded in parallel, then uploaded one by one.
Result<void> SceneOnDevice::upload_maps(gpu::Device& device, const Scene& scene) {
    struct Job {
        std::string key;
        const MaterialMap* map;
        const Material* material;
        const Mesh* mesh;
        std::optional<Result<LoadedMap>> data;
    };
    std::vector<Job> jobs;
    for (const SceneObject& object : scene.objects)
        for (const Material& material : object.mesh.materials)
            for (const MaterialMap& map : material_maps()) {
                const std::string key = texture_key(map, material);
                if (std::ranges::find(jobs, key, &Job::key) == jobs.end())
                    jobs.push_back({key, &map, &material, &object.mesh, {}});
            }
    parallel_for(jobs.size(), 1, [&](size_t begin, size_t end) {
        for (Job& job : std::span(jobs).subspan(begin, end - begin))
            job.data = map_source(*job.map, *job.material)
                           ? load_material_map(*job.map, *job.material, *job.mesh)
                           : Result<LoadedMap>({neutral_map(*job.map), {}});
    });
    for (const MaterialMap& map : material_maps())
        map_constants_.emplace_back("has_" + map.texture, std::ranges::any_of(jobs, [&](const Job& job) {
                                        return job.map == &map && map_source(map, *job.material);
                                    }));
    for (Job& job : jobs) {
        if (!*job.data) return job.data->error();
        const LoadedMap loaded = std::move(**job.data);
        if (!loaded.warning.empty()) warnings_.push_back(loaded.warning);
        DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(device, loaded.texture));
        textures_.emplace(job.key, std::move(texture));
    }
    DERMIS_TRY_ASSIGN(gpu::Texture blank,
                      gpu::Texture::upload(device, {.name = "no image",
                                                    .format = ImageFormat::rgba8,
                                                    .bytes = std::vector(4, std::byte{255})}));
    no_image_ = std::make_unique<gpu::Texture>(std::move(blank));
    return {};
}

Result<void> SceneOnDevice::upload_objects(gpu::Device& device, const Scene& scene) {
    for (const SceneObject& object : scene.objects) {
        Result<gpu::Geometry> geometry = upload_mesh(device, object.name, object.mesh,
                                                     rest_mesh(scene, geometries_.size()), scene.rest_bakes);
        if (!geometry) return geometry.error();
        geometries_.push_back(std::make_unique<gpu::Geometry>(std::move(*geometry)));
        for (const Submesh& submesh : object.mesh.submeshes) {
            const Material& material = object.mesh.materials[submesh.material];
            const MaterialClass material_class = object.classes[submesh.material];
            gpu::Draw draw = {.geometry = geometries_.back().get(),
                              .first_index = submesh.first_index,
                              .index_count = submesh.index_count,
                              .draw_class = draw_class(material, material_class)};
            for (const MaterialMap& map : material_maps())
                draw.textures[map.texture] = &textures_.at(texture_key(map, material));
            draw.values = material_values(material, material_class, scene.skin);
            has_cut_outs_ |= std::get<float>(draw.values["alpha_cutoff"]) > 0;
            draws_.push_back(std::move(draw));
        }
    }
    replace_target_weights(scene, target_weights_of(scene));
    return {};
}

// The draws are in the order in which upload_objects made them.
void SceneOnDevice::put_target_weights(const Scene& scene) {
    auto draw = draws_.begin();
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Mesh& mesh = scene.objects[i].mesh;
        for (const Submesh& submesh : mesh.submeshes)
            add_wrinkle_weights(mesh.materials[submesh.material], target_weights_[i], draw++->values);
    }
}

void SceneOnDevice::replace_target_weights(const Scene& scene, std::vector<TargetWeights> weights) {
    target_weights_ = std::move(weights);
    put_target_weights(scene);
}

// Scenes at rest have no such stream, unless a morph target alone shows wrinkles.
Result<void> SceneOnDevice::upload_tensions(gpu::Device& device, const Scene& scene) {
    has_tension_ = std::ranges::any_of(scene.objects, [](const SceneObject& object) {
        return !object.mesh.tensions.empty() || shows_wrinkles(object);
    });
    return has_tension_ ? put_tensions(device, scene) : Result<void>();
}

Result<void> SceneOnDevice::put_tensions(gpu::Device& device, const Scene& scene) {
    for (size_t i = 0; i < geometries_.size(); ++i) {
        const Mesh& mesh = scene.objects[i].mesh;
        const auto tensions = filled(mesh.tensions, mesh.positions_mm.size(), 0.0f);
        DERMIS_TRY(geometries_[i]->put(device, {"tension", 1, tensions}));
    }
    return {};
}

Result<void> SceneOnDevice::add_tensions(gpu::Device& device, const Scene& scene) {
    if (std::exchange(has_tension_, true)) return {};
    return put_tensions(device, scene);
}

std::vector<const gpu::Geometry*> SceneOnDevice::geometries() const {
    std::vector<const gpu::Geometry*> all;
    for (const auto& geometry : geometries_) all.push_back(geometry.get());
    return all;
}

Result<void> SceneOnDevice::replace_vertices(gpu::Device& device, const Scene& scene) {
    for (size_t i = 0; i < geometries_.size(); ++i) {
        if (scene.objects[i].motion.empty()) continue;
        const MovingStreams moving(scene.objects[i].mesh, rest_mesh(scene, i), scene.rest_bakes);
        for (const gpu::VertexStream& stream : moving.streams)
            DERMIS_TRY(geometries_[i]->put(device, stream));
        const Mesh& mesh = scene.objects[i].mesh;
        if (!scene.skin.blood_moves() || mesh.colors_linear.empty()) continue;
        DERMIS_TRY(geometries_[i]->put(device, {"color_linear", 4, floats_of(mesh.colors_linear)}));
    }
    replace_target_weights(scene, target_weights_of(scene));
    return upload_tensions(device, scene);
}

// The geometries stay where the draws point to them.
Result<void> SceneOnDevice::replace_objects(gpu::Device& device, const Scene& scene) {
    auto draw = draws_.begin();
    for (size_t i = 0; i < geometries_.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        DERMIS_TRY_ASSIGN(gpu::Geometry geometry, upload_mesh(device, object.name, object.mesh,
                                                              rest_mesh(scene, i), scene.rest_bakes));
        *geometries_[i] = std::move(geometry);
        for (const Submesh& submesh : object.mesh.submeshes) {
            draw->first_index = submesh.first_index;
            (draw++)->index_count = submesh.index_count;
        }
    }
    replace_target_weights(scene, target_weights_of(scene));
    uv_density_ = dermis::uv_density(scene);
    gains_key.clear();
    return upload_tensions(device, scene);
}

Result<void> SceneOnDevice::replace_gains(gpu::Device& device, std::span<const std::vector<Vec3>> gains) {
    for (size_t i = 0; i < gains.size(); ++i)
        DERMIS_TRY(geometries_[i]->put(device, {"walked_gain", 3, floats_of(gains[i])}));
    return {};
}

// The draws are in the order in which upload_objects made them.
void SceneOnDevice::update_materials(const Scene& scene) {
    auto draw = draws_.begin();
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes) {
            const Material& material = object.mesh.materials[submesh.material];
            const MaterialClass material_class = object.classes[submesh.material];
            draw->draw_class = draw_class(material, material_class);
            draw++->values = material_values(material, material_class, scene.skin);
        }
    put_target_weights(scene);
}

Result<SceneOnDevice> SceneOnDevice::upload(gpu::Device& device, const Scene& scene) {
    SceneOnDevice uploaded;
    uploaded.uv_density_ = dermis::uv_density(scene);
    DERMIS_TRY(uploaded.upload_maps(device, scene));
    DERMIS_TRY(uploaded.upload_objects(device, scene));
    DERMIS_TRY(uploaded.upload_tensions(device, scene));
    DERMIS_TRY(uploaded.upload_environment(device, scene));
    return uploaded;
}

}  // namespace dermis::inline render
