#include "subjects/unit/shapes.h"

#include <cmath>
#include <numbers>

#include "dermis/mesh/primitives.h"
#include "dermis/mesh/tangents.h"
#include "dermis/scene/placement.h"

namespace dermis::unit {
namespace {

constexpr Vec3 kSkinLinear = {0.8f, 0.52f, 0.42f}, kDarkSkinLinear = {0.2f, 0.11f, 0.08f};

// Height and slopes at x, y.
struct HeightPoint {
    float z = 0, slope_x = 0, slope_y = 0;
};

template <class Height>
Mesh height_field(float half_mm, int columns, int rows, Height height) {
    Mesh mesh = make_plane(2 * half_mm, 2 * half_mm);
    const std::vector<Submesh> submeshes = mesh.submeshes;
    mesh = {.materials = std::move(mesh.materials)};
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const Vec2 uv = {float(column) / float(columns), float(row) / float(rows)};
            const float x = (2 * uv.x - 1) * half_mm, y = (1 - 2 * uv.y) * half_mm;
            const HeightPoint point = height(x, y);
            mesh.positions_mm.push_back({x, y, point.z});
            mesh.normals.push_back(normalize(Vec3{-point.slope_x, -point.slope_y, 1}));
            mesh.uvs.push_back(uv);
        }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto a = uint32_t(row * (columns + 1) + column), b = a + 1;
            const uint32_t c = a + uint32_t(columns) + 1, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, c, d, a, d, b});
        }
    mesh.submeshes = {{.name = submeshes[0].name, .index_count = uint32_t(mesh.indices.size())}};
    compute_tangents(mesh);
    return mesh;
}

}  // namespace

SceneObject skin_object(std::string name, Mesh mesh) {
    mesh.materials.resize(1);
    mesh.materials[0].name = "skin";
    mesh.materials[0].base_color_linear = kSkinLinear;
    apply_skin(Skin{}, mesh.materials[0]);
    mesh.curvatures_per_mm.clear();  // complete_scene() fits what any loaded mesh gets
    return {.name = std::move(name), .mesh = std::move(mesh), .classes = {MaterialClass::skin}};
}

SceneObject black_object(std::string name, Mesh mesh) {
    mesh.materials.resize(1);
    mesh.materials[0] = {.name = "black", .base_color_linear = {0, 0, 0}, .roughness = 1};
    mesh.materials[0].specular = 0;
    return {.name = std::move(name), .mesh = std::move(mesh), .classes = {MaterialClass::other}};
}

Mesh plane_between(float from_mm, float to_mm) {
    Mesh mesh = make_plane(to_mm - from_mm, 2 * kReachMm);
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i) {
        mesh.positions_mm[i].x += (from_mm + to_mm) / 2;
        mesh.uvs[i].x = (mesh.positions_mm[i].x + kReachMm) / (2 * kReachMm);
    }
    return mesh;
}

SceneObject two_albedos() {
    // Two rows of cells: the upper one keeps the skin's colour.
    Mesh mesh = make_plane(2 * kReachMm, 2 * kReachMm, 2);
    const auto half = uint32_t(mesh.indices.size() / 2);
    SceneObject object = skin_object("plane", std::move(mesh));
    Material dark = object.mesh.materials[0];
    dark.name = "dark skin";
    dark.base_color_linear = kDarkSkinLinear;
    object.mesh.materials.push_back(std::move(dark));
    object.mesh.submeshes = {{.name = "light", .index_count = half},
                             {.name = "dark", .first_index = half, .index_count = half, .material = 1}};
    object.classes.push_back(MaterialClass::skin);
    return object;
}

Mesh saddle(float radius_mm) {
    constexpr int kCells = 96;
    return height_field(radius_mm, kCells, kCells, [&](float x, float y) {
        return HeightPoint{
            .z = (x * x - y * y) / (2 * radius_mm), .slope_x = x / radius_mm, .slope_y = -y / radius_mm};
    });
}

Mesh relief(float wavelength_mm, float slope) {
    constexpr float kCellsAWave = 24;
    const float k = 2 * std::numbers::pi_v<float> / wavelength_mm;
    return height_field(kReachMm, int(2 * kReachMm / wavelength_mm * kCellsAWave), 1, [&](float x, float) {
        return HeightPoint{.z = slope / k * std::sin(k * x), .slope_x = slope * std::cos(k * x)};
    });
}

SceneObject shading_board(Vec3 to_light) {
    // Far enough to stay out of the picture; its edge lies along the light that meets the plane at x = 0.
    constexpr float kAwayMm = 60, kWidthMm = 30, kThicknessMm = 1;
    Mesh board = make_box({kWidthMm, 6 * kReachMm, kThicknessMm});
    const Vec3 up = {0, 1, 0}, right = normalize(cross(up, to_light));
    const auto turned = [&](Vec3 v) { return right * v.x + up * v.y + to_light * v.z; };
    for (Vec3& p : board.positions_mm) p = turned(p - Vec3{kWidthMm / 2, 0, -kAwayMm});
    for (Vec3& n : board.normals) n = turned(n);
    for (Vec4& t : board.tangents) {
        const Vec3 along = turned({t.x, t.y, t.z});
        t = {along.x, along.y, along.z, t.w};
    }
    return black_object("board", std::move(board));
}

}  // namespace dermis::unit
