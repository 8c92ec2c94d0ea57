#include "dermis/engines/head.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "dermis/engines/engine.h"
#include "dermis/engines/head_maps.h"
#include "dermis/engines/target_curvature.h"
#include "dermis/engines/web/parts.h"
#include "dermis/image/io.h"
#include "dermis/mesh/surface_frame.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/optics/fresnel.h"
#include "dermis/render/complete_scene.h"
#include "dermis/render/renderer.h"
#include "dermis/render/seam_textures.h"
#include "dermis/scene/environment.h"
#include "dermis/scene/pose_scene.h"
#include "dermis/scene/rig_scene.h"

namespace dermis::inline engines {
namespace {

using nlohmann::json;
using web::to_json;

// shaders/include/skin/curvature.glsl has the same.
Vec3 vertex_tangent(Vec3 n) {
    const float a = n.x / std::max(1 + n.z, 1e-4f);
    return normalize(Vec3{1 - n.x * a, -n.y * a, -n.x});
}

// Numbers of the vertices as pairs: head.h.
Result<VertexNumbers> vertex_numbers(const Mesh& mesh, const std::array<Vec3, 3>& weights) {
    DERMIS_TRY_ASSIGN(const std::vector<Vec3> blurred, blurred_occlusions(mesh));
    const size_t count = mesh.positions_mm.size();
    VertexNumbers pairs(4, std::vector<Vec2>(count));
    const Vec3 own_weight = Vec3{1, 1, 1} - weights[0] - weights[1] - weights[2];
    for (size_t v = 0; v < count; ++v) {
        const Vec3 n = mesh.normals[v], t = vertex_tangent(n), b = cross(n, t);
        const CurvatureTensor s =
            mesh.curvatures_per_mm.empty() ? CurvatureTensor{} : mesh.curvatures_per_mm[v];
        const float tt = dot(t, s * t), bb = dot(b, s * b);
        const float occlusion = mesh.occlusions.empty() ? 1.0f : mesh.occlusions[v];
        const Vec3 scattered = own_weight * occlusion + weights[0] * blurred[v].x +
                               weights[1] * blurred[v].y + weights[2] * blurred[v].z;
        pairs[0][v] = {0.5f * (tt + bb), 0.5f * (tt - bb)};
        pairs[1][v] = {dot(t, s * b), scattered.x};
        pairs[2][v] = {scattered.y, scattered.z};
        pairs[3][v] = {occlusion, float(v)};
    }
    return pairs;
}

// The rotation from the axes to the frame of tangent, bitangent and normal, as a quaternion: head.h.
Vec4 frame_quaternion(Vec3 normal, Vec4 tangent) {
    const SurfaceFrame f(normal, {tangent.x, tangent.y, tangent.z});
    // Shepperd 1978, "Quaternion from Rotation Matrix": by the largest component.
    const float four[] = {1 + f.t.x - f.b.y - f.n.z, 1 - f.t.x + f.b.y - f.n.z, 1 - f.t.x - f.b.y + f.n.z,
                          1 + f.t.x + f.b.y + f.n.z};
    const size_t largest = size_t(std::ranges::max_element(four) - std::begin(four));
    const float yz = f.b.z - f.n.y, zx = f.n.x - f.t.z, xy = f.t.y - f.b.x, xy_sum = f.t.y + f.b.x,
                zx_sum = f.n.x + f.t.z, yz_sum = f.b.z + f.n.y;
    const Vec4 rows[] = {{four[0], xy_sum, zx_sum, yz},
                         {xy_sum, four[1], yz_sum, zx},
                         {zx_sum, yz_sum, four[2], xy},
                         {yz, zx, xy, four[3]}};
    const float scale = 0.5f / std::sqrt(four[largest]);
    const Vec4 q = rows[largest];
    return {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
}

void add_frames(const Mesh& mesh, VertexNumbers& numbers) {
    std::vector<Vec2> xy, zw;
    for (size_t v = 0; v < mesh.normals.size(); ++v) {
        const Vec4 q = frame_quaternion(mesh.normals[v], mesh.tangents[v]);
        xy.push_back({q.x, q.y});
        zw.push_back({q.z, q.w});
    }
    numbers.push_back(std::move(xy));
    numbers.push_back(std::move(zw));
}

Result<ImageSource> embedded(const Image& image, const std::string& name) {
    if (image.empty()) return ImageSource{};
    DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, encode_image(".png", image));
    return ImageSource{.name = name, .encoded = std::move(bytes)};
}

// glTF reads the factor of the reflectance from alpha.
Image in_alpha(const Image& single) {
    if (single.empty()) return {};
    Image all(single.width, single.height, 4, PixelFormat::u8);
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < all.width; ++x) {
            for (int c = 0; c < 3; ++c) all.set(x, y, c, 1);
            all.set(x, y, 3, single.at(x, y, 0));
        }
    return all;
}

// The maps of a material, each as a picture of its own.
struct Maps {
    Image albedo, normal, roughness, specular, occlusion;
};

Result<Maps> load_maps(const HeadInput& input, const SceneObject& object, size_t number) {
    Maps maps;
    for (const auto& [texture, image] : {std::pair{"albedo_map", &maps.albedo},
                                         {"normal_map", &maps.normal},
                                         {"roughness_map", &maps.roughness},
                                         {"specular_map", &maps.specular},
                                         {"occlusion_map", &maps.occlusion}}) {
        DERMIS_TRY_ASSIGN(*image,
                          web::load_map(object.mesh.materials[number], object.mesh, texture, input.map_side));
    }
    return maps;
}

// The material with what glTF can hold of its maps, as glTF holds them.
Result<Material> gltf_material(const SceneObject& object, size_t number, const Maps& maps) {
    Material to = object.mesh.materials[number];
    for (ImageSource Material::*map :
         {&Material::base_color_map, &Material::alpha_map, &Material::emission_map, &Material::normal_map,
          &Material::metallic_roughness_map, &Material::specular_map, &Material::occlusion_map})
        to.*map = {};
    to.scattering.reset();
    const std::string prefix = to.name + " ";
    if (!maps.albedo.empty()) {
        const Image albedo =
            to.alpha_mode == AlphaMode::opaque ? web::three_channels(maps.albedo) : maps.albedo;
        DERMIS_TRY_ASSIGN(to.base_color_map, embedded(albedo, prefix + "albedo"));
    }
    if (!maps.normal.empty() && to.normal_space == NormalSpace::tangent) {
        DERMIS_TRY_ASSIGN(to.normal_map, embedded(web::three_channels(maps.normal), prefix + "normal"));
    }
    if (!maps.roughness.empty() || !maps.occlusion.empty()) {
        DERMIS_TRY_ASSIGN(
            to.metallic_roughness_map,
            embedded(web::packed({maps.occlusion, maps.roughness, Image()}), prefix + "surface"));
        if (!maps.occlusion.empty()) to.occlusion_map = to.metallic_roughness_map;
    }
    DERMIS_TRY_ASSIGN(to.specular_map, embedded(in_alpha(maps.specular), prefix + "specular"));
    return to;
}

constexpr std::string_view class_name(MaterialClass material_class) {
    return material_class == MaterialClass::skin    ? "skin"
           : material_class == MaterialClass::other ? "other"
                                                    : "translucent";
}

// The maps as files for an engine whose importer would lose some, and the values that go with them.
Result<void> add_map_files(const Material& material, const Maps& maps, const std::string& prefix, json& made,
                           std::vector<PackageFile>& files) {
    made["albedo_linear"] = to_json(material.base_color_linear);
    made["roughness"] = to_json(material.roughness);
    made["normal_scale"] = to_json(material.normal_scale);
    made["object_space_normals"] = material.normal_space == NormalSpace::object;
    made["maps"] = json::object();
    const bool has_surface = !maps.occlusion.empty() || !maps.roughness.empty() || !maps.specular.empty();
    const Image surface =
        has_surface ? web::packed({maps.occlusion, maps.roughness, maps.specular}) : Image();
    for (const auto& [name, image] :
         {std::pair("albedo", &maps.albedo), {"normal", &maps.normal}, {"surface", &surface}}) {
        if (image->empty()) continue;
        const std::string path = prefix + "_" + name + ".png";
        DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, encode_image(".png", web::three_channels(*image)));
        files.push_back({path, std::move(bytes)});
        made["maps"][name] = path;
    }
    return {};
}

// What a skin material needs beyond glTF. Adds its object-space normal map.
Result<json> head_material_json(const SceneObject& object, size_t number, const Maps& maps,
                                const std::string& prefix, std::vector<PackageFile>& files) {
    const Material& material = object.mesh.materials[number];
    json made = {{"name", material.name},
                 {"class", class_name(object.classes[number])},
                 {"f0", to_json(float(f0_of_eta(material.ior)) * material.specular)}};
    if (maps.normal.empty() || material.normal_space != NormalSpace::object) return made;
    made["object_normal_map"] = prefix + "_normal.png";
    DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, encode_image(".png", web::three_channels(maps.normal)));
    files.push_back({prefix + "_normal.png", std::move(bytes)});
    return made;
}

// The mesh gets tangents, which its frames need. Atlas and tangents are those of `mesh`.
Result<std::optional<Rig>> rig_of_head(const HeadInput& input, const SceneObject& object, Mesh& mesh,
                                       Head& head) {
    if (object.motion.empty()) return std::optional<Rig>();
    if (input.format.still_maps) {
        head.warnings.push_back("'" + object.name + "' does not move in the engine: it has the scene's pose");
        return std::optional<Rig>();
    }
    if (!ScenePoser::can_pose(object)) {
        head.warnings.push_back("'" + object.name +
                                "' does not move in the engine: it is subdivided or displaced");
        return std::optional<Rig>();
    }
    if (mesh.tangents.empty())
        for (const Vec3& n : mesh.normals) {
            const Vec3 t = vertex_tangent(n);
            mesh.tangents.push_back({t.x, t.y, t.z, 1});
        }
    SceneObject moving = object;
    moving.mesh = mesh;
    DERMIS_TRY_ASSIGN(std::optional<Rig> rig, rig_of(moving, input.scene.motion.pose()));
    if (rig && input.format.linear_keys) make_keys_linear(*rig);
    return rig;
}

// head.h. Null where no target changes the curvature.
Result<json> add_target_curvatures(const HeadInput& input, size_t index, Head& head) {
    const SceneObject& object = input.scene.objects[index];
    DERMIS_TRY_ASSIGN(const std::vector<TargetCurvature> all,
                      target_curvatures(object, input.scene.motion.pose(), object.motion.targets));
    if (all.empty()) return json();
    json names = json::array();
    for (const TargetCurvature& target : all) names.push_back(target.name);
    const std::string path = fmt::format("{}_curvature.png", index);
    DERMIS_TRY(add_picture(path, curvature_picture(all), head.files));
    return json{{"file", path},
                {"targets", names},
                {"rows", curvature_rows(object.mesh.positions_mm.size())},
                {"most_per_mm", to_json(kMostMeanCurvatureChange)}};
}

// Adds the mesh and its maps. `numbers`: the vertices' own, where they are not in the mesh.
Result<json> head_object_json(const HeadInput& input, size_t index, Head& head, VertexNumbers& numbers) {
    const SceneObject& object = input.scene.objects[index];
    Mesh mesh = object.mesh;
    json materials = json::array();
    for (size_t i = 0; i < mesh.materials.size(); ++i) {
        DERMIS_TRY_ASSIGN(const Maps maps, load_maps(input, object, i));
        const bool map_files = input.format.map_files && object.classes[i] == MaterialClass::skin;
        DERMIS_TRY_ASSIGN(mesh.materials[i], gltf_material(object, i, map_files ? Maps() : maps));
        if (object.classes[i] == MaterialClass::skin)
            mesh.materials[i].base_color_linear =
                mesh.materials[i].base_color_linear * input.scene.skin.albedo_tint_linear;
        if (object.classes[i] == MaterialClass::translucent)
            head.warnings.push_back("material '" + mesh.materials[i].name +
                                    "' is translucent; the engine draws it as glTF has it");
        const std::string prefix = fmt::format("{}_{}", index, i);
        DERMIS_TRY_ASSIGN(json made,
                          head_material_json(object, i, map_files ? Maps() : maps, prefix, head.files));
        if (map_files) DERMIS_TRY(add_map_files(mesh.materials[i], maps, prefix, made, head.files));
        materials.push_back(std::move(made));
    }
    mesh.atlas_uvs = atlas_uvs_of(mesh);
    DERMIS_TRY_ASSIGN(numbers, vertex_numbers(mesh, input.occlusion_weights));
    DERMIS_TRY_ASSIGN(const std::optional<Rig> rig, rig_of_head(input, object, mesh, head));
    if (rig) add_frames(mesh, numbers);
    for (json& material : materials) material["moves"] = rig.has_value();
    const std::span<const std::vector<Vec2>> in_mesh =
        input.format.still_maps ? std::span<const std::vector<Vec2>>() : numbers;
    DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, glb_bytes(mesh, {}, {}, in_mesh, rig ? &*rig : nullptr));
    const std::string path = fmt::format("object_{}.glb", index);
    head.files.push_back({path, std::move(bytes)});
    json made = {{"file", path}, {"name", object.name}, {"box_mm", box_json(mesh)}, {"materials", materials}};
    if (!rig) return made;
    DERMIS_TRY_ASSIGN(json changes, add_target_curvatures(input, index, head));
    if (!changes.is_null()) made["curvature_of_targets"] = std::move(changes);
    return made;
}

json head_light_json(const Light& light, bool casts_shadow) {
    json made = {{"name", light.name},
                 {"kind", light.kind == LightKind::directional ? "directional"
                          : light.kind == LightKind::point     ? "point"
                                                               : "spot"},
                 {"color_linear", to_json(light.color_linear)},
                 {"intensity", to_json(light.intensity)},
                 {"to_light", to_json(light.to_light_world)},
                 {"casts_shadow", casts_shadow}};
    if (light.kind == LightKind::directional) return made;
    made["position_mm"] = to_json(light.position_mm);
    made["inner_angle_rad"] = to_json(light.inner_angle_rad);
    made["outer_angle_rad"] = to_json(light.outer_angle_rad);
    return made;
}

// With still_maps, adds the lights' maps.
Result<json> head_lights_json(const HeadInput& input, Head& head) {
    const Scene& scene = input.scene;
    json lights = json::array();
    const std::vector<int> shadow_maps = scene.shadow_maps();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        lights.push_back(head_light_json(light, shadow_maps[i] >= 0));
        if (!input.format.still_maps || shadow_maps[i] < 0) continue;
        if (!can_have_shadow_map(scene, light)) {
            head.warnings.push_back("light '" + light.name + "' has no shadows: it is too near to the head");
            continue;
        }
        DERMIS_TRY_ASSIGN(lights.back()["shadow"],
                          add_shadow_map(scene, light, fmt::format("shadow_{}.exr", i), head.files));
    }
    return lights;
}

// 16 bits as two bytes, for a reader of 8 bits: the high ones above the low ones.
Image in_two_bytes(const Image& values) {
    Image bytes(values.width, 2 * values.height, values.channels, PixelFormat::u8);
    for (int y = 0; y < values.height; ++y)
        for (int x = 0; x < values.width; ++x)
            for (int c = 0; c < values.channels; ++c) {
                const auto code = int(std::lround(values.at(x, y, c) * 65535));
                bytes.set(x, y, c, float(code >> 8) / 255);
                bytes.set(x, values.height + y, c, float(code & 255) / 255);
            }
    return bytes;
}

// The renderer's own three textures: head.h. Red has 10 bits: with 8 three.js loses .01 of the captured
// share.
Result<json> add_normals(const DiffusedNormals& normals, bool red_in_halves, Head& head) {
    const std::vector<gpu::TextureData> textures = diffused_normals_textures(normals);
    Image green(normals.size, normals.size, 3, PixelFormat::u8),
        spread = green,
        red(normals.size, normals.size, 3, red_in_halves ? PixelFormat::f16 : PixelFormat::f32);
    for (int y = 0; y < normals.size; ++y)
        for (int x = 0; x < normals.size; ++x) {
            const size_t at = size_t(y) * size_t(normals.size) + size_t(x);
            uint32_t bits = 0;
            std::memcpy(&bits, &textures[0].bytes[4 * at], 4);
            for (int c = 0; c < 3; ++c) {
                red.set(x, y, c, float(bits >> (10 * c) & 1023) / 1023);
                green.set(x, y, c, float(textures[1].bytes[4 * at + size_t(c)]) / 255);
            }
            for (int c = 0; c < 2; ++c)
                spread.set(x, y, c, float(textures[2].bytes[2 * at + size_t(c)]) / 255);
            spread.set(x, y, 2, float(textures[1].bytes[4 * at + 3]) / 255);
        }
    const std::string red_name = red_in_halves ? "normals_red.exr" : "normals_red.png";
    DERMIS_TRY(add_picture(red_name, red_in_halves ? red : in_two_bytes(red), head.files));
    DERMIS_TRY(add_picture("normals_green.png", green, head.files));
    DERMIS_TRY(add_picture("normals_spread.png", spread, head.files));
    return json{red_name, "normals_green.png", "normals_spread.png"};
}

Result<json> add_thickness(const Image& thickness_mm, Head& head) {
    Image image(thickness_mm.width, thickness_mm.height, 3, PixelFormat::u8);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.set(x, y, c, std::clamp(thickness_mm.at(x, y, 0) / kThicknessMaxMm, 0.0f, 1.0f));
    DERMIS_TRY(add_picture("thickness.png", image, head.files));
    return json{{"file", "thickness.png"}, {"max_mm", kThicknessMaxMm}};
}

// The polynomial that Unity's SampleSH() evaluates: 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2. Lambert's
// bands over pi are 1, 2/3 and 1/4 (Ramamoorthi, Hanrahan 2001); the second one is turned as a quadratic
// form.
json ambient_probe(const EnvironmentLight& light, const Environment& environment) {
    constexpr float kBand[] = {0.282095f, 2 * 0.488603f / 3};
    constexpr float kMixed = 1.092548f / 4, kZ = 0.315392f / 4, kDifference = 0.546274f / 4;
    const float c = std::cos(environment.yaw_rad), s = std::sin(environment.yaw_rad);
    json numbers = json::array();
    std::array<Vec3, 9> probe;
    const auto& l = light.radiance_sh;
    // The environment's x and z of Unity's: x' = -c x - s z, z' = -s x + c z.
    probe[0] = l[0] * kBand[0];
    probe[1] = l[1] * kBand[1];
    probe[2] = (l[2] * c - l[3] * s) * kBand[1];
    probe[3] = (l[3] * -c - l[2] * s) * kBand[1];
    const Vec3 xy = l[4] * kMixed, yz = l[5] * kMixed, xz = l[7] * kMixed, zz = l[6] * kZ,
               difference = l[8] * kDifference;
    // Diagonal and mixed elements of the form, then of the turned one.
    const Vec3 m_xx = difference - zz, m_yy = difference * -1 - zz, m_zz = zz * 2;
    const Vec3 t_xx = m_xx * (c * c) + m_zz * (s * s) + xz * (c * s);
    const Vec3 t_zz = m_xx * (s * s) + m_zz * (c * c) - xz * (c * s);
    const Vec3 t_xz = (m_xx - m_zz) * (2 * c * s) - xz * (c * c - s * s);
    probe[4] = xy * -c - yz * s;
    probe[5] = yz * c - xy * s;
    probe[6] = t_zz * 0.5f;
    probe[7] = t_xz;
    probe[8] = (t_xx - m_yy) * 0.5f;
    for (const Vec3& one : probe)
        for (const float number : {one.x, one.y, one.z})
            numbers.push_back(to_json(number * environment.intensity));
    return numbers;
}

Result<json> add_panorama(const Environment& environment, const HeadFormat& format, Head& head) {
    if (environment.kind == EnvironmentKind::none) return json();
    DERMIS_TRY_ASSIGN(const Image panorama, load_panorama(environment));
    DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, encode_image(".hdr", panorama));
    head.files.push_back({"environment.hdr", std::move(bytes)});
    DERMIS_TRY_ASSIGN(const EnvironmentLight light, prepare_environment(environment));
    json harmonics = json::array();
    for (const Vec3& one : light.radiance_sh) harmonics.push_back(to_json(one));
    json made = {{"file", "environment.hdr"},
                 {"intensity", to_json(environment.intensity)},
                 {"radiance_sh", harmonics},
                 {"yaw_rad", to_json(environment.yaw_rad)}};
    if (format.ambient_probe) made["ambient_probe"] = ambient_probe(light, environment);
    if (format.still_maps) made["ambient_terms"] = ambient_terms(light, environment);
    if (format.reflections) {
        DERMIS_TRY_ASSIGN(made["reflections"], add_reflections(environment, panorama, head.files));
    }
    return made;
}

json head_camera_json(const Camera& camera) {
    return {{"eye_mm", to_json(camera.eye_mm)},
            {"target_mm", to_json(camera.target_mm)},
            {"up", to_json(camera.up_world)},
            {"vertical_fov_rad", to_json(camera.vertical_fov_rad)}};
}

}  // namespace

Result<Head> make_head(const HeadInput& input) {
    const Scene& scene = input.scene;
    Head head;
    json objects = json::array();
    std::vector<VertexNumbers> numbers(scene.objects.size());
    bool any_skin = false;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        any_skin = any_skin || std::ranges::count(scene.objects[i].classes, MaterialClass::skin) > 0;
        DERMIS_TRY_ASSIGN(json object, head_object_json(input, i, head, numbers[i]));
        objects.push_back(std::move(object));
    }
    if (!any_skin) return Error{scene.name + " has no skin to export"};
    web::warn_of_materials(scene, "package", head.warnings);
    json made = {
        {"name", scene.name},
        {"credit", scene.credit},
        {"camera", head_camera_json(scene.camera)},
        {"bounds",
         {{"center_mm", to_json(scene.bounds_center_mm)}, {"radius_mm", to_json(scene.bounds_radius_mm)}}},
        {"background_linear", to_json(scene.background_linear)},
        {"exposure", to_json(std::exp2(scene.exposure_ev))},
        {"tone_map", tone_map_names()[size_t(scene.tone_map)]},
        {"penumbra_mm", to_json(DrawSettings{}.penumbra_mm)},
        {"objects", objects}};
    DERMIS_TRY_ASSIGN(made["lights"], head_lights_json(input, head));
    if (input.format.still_maps) {
        DERMIS_TRY_ASSIGN(made["vertex_maps"], add_vertex_maps(scene, numbers, head.files));
    }
    DERMIS_TRY_ASSIGN(made["environment"], add_panorama(scene.environment, input.format, head));
    if (input.format.reflected_shares) DERMIS_TRY(add_reflected_shares(head.files));
    if (input.normals.size > 0) {
        DERMIS_TRY_ASSIGN(made["baked_normals"], add_normals(input.normals, input.format.map_files, head));
    }
    if (!input.thickness_mm.empty()) {
        DERMIS_TRY_ASSIGN(made["thickness"], add_thickness(input.thickness_mm, head));
    }
    head.files.push_back({"scene.json", to_bytes(made.dump(1) + "\n")});
    return head;
}

}  // namespace dermis::inline engines
