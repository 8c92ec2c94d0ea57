#include "dermis/scene/builtin.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/angle.h"
#include "dermis/base/text.h"
#include "dermis/bust/bust.h"
#include "dermis/scene/glasses.h"

namespace dermis {
namespace {

// Centres are this many times the sum of two radii apart, so that no sphere shadows its neighbour while the
// key light's direction is at most 50 degrees off the plane between them (a test holds the default to it).
constexpr float kSphereSpacing = 1.3f;

Mesh make_latitude_sphere(float radius_mm, Vec3 center_mm) {
    constexpr int kRows = 48, kColumns = 96;
    Mesh mesh;
    for (int row = 0; row <= kRows; ++row)
        for (int column = 0; column <= kColumns; ++column) {
            const float u = float(column) / kColumns, v = float(row) / kRows;
            const float azimuth = u * 2 * kPi, polar = v * kPi;
            const Vec3 n = {-std::sin(polar) * std::sin(azimuth), std::cos(polar),
                            -std::sin(polar) * std::cos(azimuth)};
            mesh.positions_mm.push_back(center_mm + n * radius_mm);
            mesh.normals.push_back(n);
            mesh.tangents.push_back({-std::cos(azimuth), 0, std::sin(azimuth), 1});
            mesh.uvs.push_back({u, v});
            mesh.curvatures_per_mm.push_back(1 / radius_mm);
        }
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const uint32_t a = uint32_t(row * (kColumns + 1) + column), b = a + 1, c = a + kColumns + 1,
                           d = c + 1;
            if (row > 0) mesh.indices.insert(mesh.indices.end(), {a, c, b});
            if (row + 1 < kRows) mesh.indices.insert(mesh.indices.end(), {b, c, d});
        }
    return mesh;
}

SceneObject make_sphere_object(float radius_mm, Vec3 center_mm) {
    SceneObject object{.name = "sphere_" + to_text(radius_mm) + "mm",
                       .mesh = make_latitude_sphere(radius_mm, center_mm),
                       .classes = {MaterialClass::skin}};
    object.mesh.materials = {{.name = "skin", .base_color_linear = {0.8f, 0.52f, 0.42f}}};
    apply_skin(Skin{}, object.mesh.materials[0]);
    object.mesh.submeshes = {
        {.name = object.name, .index_count = uint32_t(object.mesh.indices.size()), .material = 0}};
    return object;
}

// Resting on y = 0, the row centred on x = 0.
std::vector<SceneObject> make_spheres() {
    float x_mm[4] = {};
    for (int i = 1; i < 4; ++i)
        x_mm[i] = x_mm[i - 1] + kSphereSpacing * (kSphereRadiiMm[i - 1] + kSphereRadiiMm[i]);
    const float middle_mm = (x_mm[0] - kSphereRadiiMm[0] + x_mm[3] + kSphereRadiiMm[3]) / 2;
    std::vector<SceneObject> objects;
    for (int i = 0; i < 4; ++i) {
        objects.push_back(make_sphere_object(kSphereRadiiMm[i], {x_mm[i] - middle_mm, kSphereRadiiMm[i], 0}));
        // A quarter of one atlas each, with a gutter, so that texture-space methods can light them all at
        // once.
        for (Vec2& uv : objects.back().mesh.uvs)
            uv = Vec2{0.5f * float(i % 2), 0.5f * float(i / 2)} + Vec2{0.02f, 0.02f} + uv * 0.46f;
    }
    return objects;
}

ImageSource made_by_code(std::string name, const Image& image) {
    return {.name = std::move(name),
            .width = image.width,
            .height = image.height,
            .channels = image.channels,
            .pixels = image.bytes};
}

// Maps are told apart by their names: "builtin:bust tone=5".
std::string bust_name(const BustParams& params) {
    std::string name = "builtin:bust";
    const BustParams standard;
    for (const BustParamInfo& info : bust_param_table())
        if (params.*info.member != standard.*info.member)
            name += " " + std::string(info.name) + "=" + to_text(params.*info.member);
    if (params.seed != standard.seed) name += " seed=" + std::to_string(params.seed);
    return name;
}

Result<std::vector<SceneObject>> make_bust_objects(const BustParams& params) {
    Result<Bust> bust = make_bust(params);
    if (!bust) return bust.error();
    SceneObject object{.name = "bust", .mesh = std::move(bust->mesh), .classes = {MaterialClass::skin}};
    object.mesh.materials.resize(1);
    const std::string name = bust_name(params);
    Material& skin = object.mesh.materials[0];
    skin.base_color_linear = {1, 1, 1};
    skin.roughness = 1;
    skin.base_color_map = made_by_code(name + " albedo", bust->albedo);
    skin.normal_map = made_by_code(name + " normal", bust->normal);
    skin.roughness_map = made_by_code(name + " roughness", bust->roughness);
    skin.specular_map = made_by_code(name + " specular", bust->specular);
    skin.kernel_size_map = made_by_code(name + " kernel size", bust->kernel_size);
    std::vector<SceneObject> objects;
    objects.push_back(std::move(object));
    return objects;
}

}  // namespace

std::vector<std::string> builtin_mesh_names() {
    return {"bust", "glasses", "spheres"};
}

Result<std::vector<SceneObject>> make_builtin_objects(std::string_view name, const BustParams& bust) {
    if (name == "spheres") return make_spheres();
    if (name == "bust") return make_bust_objects(bust);
    if (name == "glasses") return std::vector<SceneObject>{make_glasses()};
    return Error{unknown_name("built-in scene", name, builtin_mesh_names())};
}

void apply_skin(const Skin& skin, Material& material) {
    material.ior = skin.ior;
    material.roughness = skin.roughness;
    material.specular = skin.specular;
}

void compute_bounds(Scene& scene) {
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = -low;
    for (const SceneObject& object : scene.objects)
        for (const Vec3 p : object.mesh.positions_mm) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    scene.bounds_center_mm = low.x <= high.x ? (low + high) * 0.5f : Vec3{};
    scene.bounds_radius_mm = 0;
    for (const SceneObject& object : scene.objects)
        for (const Vec3 p : object.mesh.positions_mm)
            scene.bounds_radius_mm = std::max(scene.bounds_radius_mm, length(p - scene.bounds_center_mm));
    if (scene.bounds_radius_mm <= 0) scene.bounds_radius_mm = 1;
}

void light_in_studio(Scene& scene) {
    scene.lights = {
        {.name = "key",
         .color_linear = {1, 0.93f, 0.84f},
         .intensity = kPi,
         .to_light_world = direction_from_yaw_pitch(-50 * kRadiansPerDegree, 35 * kRadiansPerDegree),
         .is_key = true}};
    scene.environment = {.kind = EnvironmentKind::studio, .intensity = 0.75f};
}

void place_in_studio(Scene& scene) {
    compute_bounds(scene);
    light_in_studio(scene);
    scene.exposure_ev = 0.6f;
    scene.camera = framing_camera(scene.bounds_center_mm, scene.bounds_radius_mm);
}

const Light& Scene::key_light() const {
    const auto found = std::ranges::find_if(lights, &Light::is_key);
    return found == lights.end() ? lights.front() : *found;
}

}  // namespace dermis
