#pragma once
// For the tests: a wall of tiles whose shading normals and curvatures are chosen, so that a picture of it is
// a table of the shader's diffuse term.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "dermis/mesh/primitives.h"
#include "dermis/scene/environment.h"
#include "dermis/technique/gain.h"
#include "render/render_test.h"
#include "support/built_in.h"

namespace dermis {

constexpr int kGrid = 64;
constexpr double kGridMaxCurvaturePerMm = 1;

inline double grid_cosine(int x) {
    return -1 + 2 * (x + 0.5) / kGrid;
}
inline double grid_curvature_per_mm(int y) {
    return kGridMaxCurvaturePerMm * (y + 0.5) / kGrid;
}
/// With the light from +X its N.L is grid_cosine(x).
inline Vec3 grid_normal(int x) {
    const auto t = float(grid_cosine(x));
    return {t, std::sqrt(1 - t * t), 0};
}

/// Tiles of 1 mm that face the camera, one per pixel of a kGrid x kGrid picture. White, and lit with
/// irradiance pi, so that radiance is the diffuse term itself. No environment.
inline Scene make_grid_scene() {
    Scene scene{.name = "grid"};
    SceneObject object{.name = "grid", .classes = {MaterialClass::skin}};
    Mesh& mesh = object.mesh;
    for (int y = 0; y < kGrid; ++y)
        for (int x = 0; x < kGrid; ++x) {
            const auto first = uint32_t(mesh.positions_mm.size());
            for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                mesh.positions_mm.push_back({float(x + dx - kGrid / 2), float(kGrid / 2 - y - dy), 0});
                mesh.normals.push_back(grid_normal(x));
                mesh.uvs.push_back({float(x + dx) / kGrid, float(y + dy) / kGrid});
                mesh.tangents.push_back({0, 0, 1, 1});
                mesh.curvatures_per_mm.push_back(
                    isotropic_curvature(float(grid_curvature_per_mm(y)), grid_normal(x)));
                mesh.occlusions.push_back(1);
            }
            mesh.indices.insert(mesh.indices.end(),
                                {first, first + 2, first + 1, first, first + 3, first + 2});
        }
    mesh.materials = {{.name = "white", .base_color_linear = {1, 1, 1}}};
    mesh.submeshes = {{.name = "grid", .index_count = uint32_t(mesh.indices.size())}};
    scene.objects.push_back(std::move(object));
    scene.lights = {
        {.name = "side", .intensity = 3.14159265f, .to_light_world = {1, 0, 0}, .casts_shadow = false}};
    scene.environment.kind = EnvironmentKind::none;
    scene.background_linear = {};
    scene.camera = {.eye_mm = {0, 0, 1000}, .vertical_fov_rad = 2 * std::atan(kGrid / 2 / 1000.0f)};
    scene.bounds_radius_mm = 50;
    return scene;
}

/// A normal map of fine stripes that lean left and right.
inline ImageSource striped_normal_map() {
    std::vector<std::byte> pixels;
    for (int i = 0; i < 256 * 256; ++i)
        for (const int value : {(i / 4) % 2 ? 190 : 65, 127, 215}) pixels.push_back(std::byte(value));
    return {.name = "stripes", .width = 256, .height = 256, .channels = 3, .pixels = std::move(pixels)};
}

/// The grid's place lit by the studio alone.
inline Scene make_studio_grid_scene() {
    Scene scene = make_grid_scene();
    scene.lights.clear();
    scene.environment = {.kind = EnvironmentKind::studio, .intensity = 1};
    return scene;
}

/// A wall of 64 mm that faces the camera, lit from the left at 45 degrees. A bar above it shadows a part.
inline Scene make_wall_and_bar(float bar_x_mm, float bar_z_mm) {
    Scene scene = make_grid_scene();
    SceneObject& object = scene.objects[0];
    object.mesh = make_plane(64, 64, 2);
    object.mesh.materials[0].base_color_linear = {1, 1, 1};
    object.mesh.occlusions.assign(object.mesh.positions_mm.size(), 1);
    SceneObject bar = object;
    bar.name = "bar";
    for (Vec3& p : bar.mesh.positions_mm) p = {0.3f * p.x + bar_x_mm, p.y, bar_z_mm};
    scene.objects.push_back(bar);
    scene.camera = {.eye_mm = {0, 0, 1000}, .vertical_fov_rad = 2 * std::atan(32 / 1000.0f)};
    scene.lights[0] = {.name = "key", .intensity = 3.14159265f, .to_light_world = normalize(Vec3{-1, 0, 1})};
    return scene;
}

using Settings = std::vector<std::pair<std::string, std::string>>;

class GridTest : public RenderTest {
  protected:
    /// The tiles have curvatures, so a gain that is not asked for would be in every number.
    static ParameterValues values_of(const Technique& technique, const Settings& settings) {
        ParameterValues values = without_gain(ParameterValues(technique.parameters));
        for (const auto& [name, text] : settings) EXPECT_TRUE(values.set(name, text)) << name;
        return values;
    }
    /// The grid drawn, one tile a pixel.
    static Image draw_grid(const Scene& scene, const Technique& technique, const Settings& settings,
                           const std::string& view = "diffuse") {
        Renderer renderer = make_renderer(scene);
        return radiance(renderer, technique, values_of(technique, settings),
                        {.width = kGrid, .height = kGrid, .view = view, .deep = true});
    }
};

class PreintegratedTest : public GridTest {
  protected:
    static const Technique& technique() { return built_in_technique("preintegrated"); }
    /// The defaults but for normals: baked ones are made of positions, and the grid's tiles lie in one plane.
    static ParameterValues values_of(const Settings& settings) {
        return GridTest::values_of(technique(), with_blended_normals(settings));
    }
    static Image draw_grid(const Scene& scene, const Settings& settings,
                           const std::string& view = "diffuse") {
        return GridTest::draw_grid(scene, technique(), with_blended_normals(settings), view);
    }

  private:
    static Settings with_blended_normals(const Settings& settings) {
        Settings all = {{"normals", "blended"}};
        all.insert(all.end(), settings.begin(), settings.end());
        return all;
    }
};

}  // namespace dermis
