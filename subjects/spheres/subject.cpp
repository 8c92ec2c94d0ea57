// Four spheres of skin with known curvature, to see and test its effect.

#include <cmath>
#include <numbers>

#include "dermis/base/text.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/subject.h"
#include "subjects/spheres/spheres.h"

namespace dermis {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

struct SpheresParams {
    /// Wide enough that each is a sphere alone, whose exact answer is known: the widest Gaussian of skin (2.7
    /// mm) does not reach from one to the next, and none shadows another while the key light is at most 50
    /// degrees off the plane between them.
    float gap_mm = 8;
};

Mesh make_latitude_sphere(float radius_mm, Vec3 center_mm) {
    constexpr int kRows = 48, kColumns = 96;
    Mesh mesh;
    for (int row = 0; row <= kRows; ++row)
        for (int column = 0; column <= kColumns; ++column) {
            const float u = float(column) / kColumns, v = float(row) / kRows;
            // Equal numbers at the seam and the poles: edges are shared only if positions are equal.
            const float azimuth = float(column % kColumns) / kColumns * 2 * kPi, polar = v * kPi;
            const float ring = row % kRows == 0 ? 0 : std::sin(polar);
            const Vec3 n = {-ring * std::sin(azimuth), std::cos(polar), -ring * std::cos(azimuth)};
            mesh.positions_mm.push_back(center_mm + n * radius_mm);
            mesh.normals.push_back(n);
            mesh.tangents.push_back({-std::cos(azimuth), 0, std::sin(azimuth), 1});
            mesh.uvs.push_back({u, v});
            mesh.curvatures_per_mm.push_back(isotropic_curvature(1 / radius_mm, n));
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

// All touch y = 0; the row is centred on x = 0.
Result<SubjectScene> make(const ParameterValues& values) {
    const float gap_mm = values.as<SpheresParams>().gap_mm;
    float x_mm[4] = {};
    for (int i = 1; i < 4; ++i) x_mm[i] = x_mm[i - 1] + kSphereRadiiMm[i - 1] + gap_mm + kSphereRadiiMm[i];
    const float middle_mm = (x_mm[0] - kSphereRadiiMm[0] + x_mm[3] + kSphereRadiiMm[3]) / 2;
    SubjectScene scene;
    for (int i = 0; i < 4; ++i) {
        scene.objects.push_back(
            make_sphere_object(kSphereRadiiMm[i], {x_mm[i] - middle_mm, kSphereRadiiMm[i], 0}));
        // A quarter of one atlas each, with a gutter, so that texture-space methods can light them all at
        // once.
        for (Vec2& uv : scene.objects.back().mesh.uvs)
            uv = Vec2{0.5f * float(i % 2), 0.5f * float(i / 2)} + Vec2{0.02f, 0.02f} + uv * 0.46f;
    }
    return scene;
}

}  // namespace

Subject make_spheres_subject() {
    return {.name = "spheres",
            .summary = "four spheres of radius 2, 4, 8 and 16 mm",
            .parameters = ParameterTableBuilder<SpheresParams>()
                              .number(&SpheresParams::gap_mm, "gap_mm", "mm", 0, 100, "between neighbours")
                              .build(),
            .make = make};
}

}  // namespace dermis
