// Curvature from the vertices or from an image is a property of the skin, so the camera must not change it.
// The quotient of derivatives depends on facets and camera; its change is measured here.

#include <gtest/gtest.h>

#include "render/grid_scene.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

// The bust without its maps: whatever changes is not their minification.
Scene bare_bust() {
    Result<Scene> scene = load_built_in_scene("bust");
    EXPECT_TRUE(scene && complete_scene(*scene));
    for (SceneObject& object : scene->objects)
        for (Material& material : object.mesh.materials) material = Material{};
    return *scene;
}

// The built-in spheres with their curvature in an image too: each sphere's quarter of the atlas has its own
// value.
Scene spheres_with_map() {
    Result<Scene> scene = load_built_in_scene("builtin:spheres");
    EXPECT_TRUE(scene && complete_scene(*scene));
    constexpr float kScalePerMm = 0.5f;
    for (SceneObject& object : scene->objects) {
        const float curvature_per_mm = mean_curvature(object.mesh.curvatures_per_mm[0]);
        object.mesh.materials[0].curvature_map = {
            .name = "curvature of " + object.name,
            .width = 1,
            .height = 1,
            .channels = 1,
            .pixels = {std::byte(std::lround(255 * curvature_per_mm / kScalePerMm))}};
        object.mesh.materials[0].curvature_scale_per_mm = kScalePerMm;
    }
    return *scene;
}

struct ZoomChange {
    double largest = 0, mean = 0;
    size_t compared = 0;
};

class PreintegratedZoom : public PreintegratedTest {
  protected:
    // Diffuse light of the picture's middle against the same seen through a quarter of the angle: the centre
    // of wide pixel i lies between the zoomed pixels 4 i - 191 and 4 i - 190. Relative to the light plus 1.
    static ZoomChange zoom_by_four(const Scene& wide_scene, const std::string& curvature) {
        Scene zoomed_scene = wide_scene;
        zoomed_scene.camera.vertical_fov_rad =
            2 * std::atan(std::tan(wide_scene.camera.vertical_fov_rad / 2) / 4);
        Renderer wide_renderer = make_renderer(wide_scene), zoomed_renderer = make_renderer(zoomed_scene);
        const DrawSettings settings = {.width = 128, .height = 128, .view = "diffuse"};
        const ParameterValues values = values_of({{"curvature", curvature}});
        const Image wide = radiance(wide_renderer, technique(), values, settings);
        const Image zoomed = radiance(zoomed_renderer, technique(), values, settings);
        ZoomChange change;
        for (int y = 48; y < 80; ++y)
            for (int x = 48; x < 80; ++x) {
                double mean = 0, coverage = 0;
                for (const int dy : {-191, -190})
                    for (const int dx : {-191, -190}) {
                        mean += zoomed.at(4 * x + dx, 4 * y + dy, 0) / 4;
                        coverage += zoomed.at(4 * x + dx, 4 * y + dy, 3) / 4;
                    }
                if (coverage < 1 || wide.at(x, y, 3) < 1) continue;
                const double relative = std::abs(mean - double(wide.at(x, y, 0))) / (mean + 1);
                change.largest = std::max(change.largest, relative);
                change.mean += relative;
                ++change.compared;
            }
        change.mean /= double(std::max<size_t>(change.compared, 1));
        return change;
    }
};

}  // namespace

TEST_F(PreintegratedZoom, changes_nothing_with_curvature_at_the_vertices_or_from_an_image) {
    const Scene scene = spheres_with_map();
    for (const char* curvature : {"vertex", "image"}) {
        const ZoomChange change = zoom_by_four(scene, curvature);
        EXPECT_GT(change.compared, 100u);
        EXPECT_LT(change.largest, 0.01) << curvature;
    }
}

TEST_F(PreintegratedZoom, changes_the_shading_with_the_derivative_more_than_with_the_vertices) {
    const Scene scene = bare_bust();
    const ZoomChange vertex = zoom_by_four(scene, "vertex"), derivative = zoom_by_four(scene, "derivative");
    RecordProperty("vertex_mean", std::to_string(vertex.mean));
    RecordProperty("derivative_mean", std::to_string(derivative.mean));
    EXPECT_GT(derivative.mean, vertex.mean);
    EXPECT_LT(derivative.mean, 0.008);
}

TEST_F(PreintegratedZoom, finds_the_same_skin_from_an_image_as_from_the_vertices) {
    const Scene scene = spheres_with_map();
    Renderer renderer = make_renderer(scene);
    const DrawSettings settings = {.width = 64, .height = 64, .view = "diffuse"};
    const Image vertex = radiance(renderer, technique(), values_of({{"curvature", "vertex"}}), settings);
    const Image image = radiance(renderer, technique(), values_of({{"curvature", "image"}}), settings);
    // An 8-bit map holds 1/16 mm within 3 %.
    EXPECT_LT(relative_difference(vertex, image, 1), 0.03);
}

// From 60 mm a texel of the normal map covers several pixels, and the smoother reads have to stay smoother.
TEST_F(PreintegratedZoom, keeps_scattering_at_bumps_in_a_close_up) {
    Scene scene = load("builtin:spheres");
    constexpr int kSize = 512;
    std::vector<std::byte> texels;
    for (int i = 0; i < kSize * kSize; ++i) {
        // Ridges two texels wide.
        const int tilt = (i / 2 + i / kSize / 2) % 2 ? 96 : 160;
        for (const int value : {tilt, 128, 223}) texels.push_back(std::byte(value));
    }
    for (SceneObject& object : scene.objects)
        object.mesh.materials[0].normal_map = {
            .name = "ridges", .width = kSize, .height = kSize, .channels = 3, .pixels = texels};
    // At the front of the largest sphere, all of the picture skin.
    const std::vector<Vec3>& positions_mm = scene.objects.back().mesh.positions_mm;
    Vec3 center_mm;
    for (const Vec3 p : positions_mm) center_mm += p * (1.0f / float(positions_mm.size()));
    const Vec3 to_eye_mm = scene.camera.eye_mm - scene.camera.target_mm;
    scene.camera.target_mm = center_mm;
    scene.camera.eye_mm = center_mm + to_eye_mm;
    scene.camera.vertical_fov_rad /= 40;
    Renderer renderer = make_renderer(scene);
    const DrawSettings settings = {.width = 64, .height = 64, .view = "diffuse"};
    const auto drawn = [&](const char* normals) {
        return radiance(renderer, technique(), values_of({{"normals", normals}, {"shadow", "plain"}}),
                        settings);
    };
    const Image sharp = drawn("sharp"), smooth = drawn("smooth"), blended = drawn("blended");
    EXPECT_GT(relative_difference(sharp, smooth, 1), 0.05);
    EXPECT_GT(relative_difference(sharp, blended, 1), 0.05);
}

TEST_F(PreintegratedZoom, warns_where_curvature_is_to_come_from_an_image_that_is_not_there) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const DrawSettings settings = {.width = 8, .height = 8};
    radiance(renderer, technique(), values_of({{"curvature", "vertex"}}), settings);
    EXPECT_TRUE(renderer.warnings().empty());
    radiance(renderer, technique(), values_of({{"curvature", "image"}}), settings);
    ASSERT_EQ(renderer.warnings().size(), 1u);
    EXPECT_NE(renderer.warnings()[0].find("material 'skin' has no curvature map"), std::string::npos);
}

// Maps of other tools have flat skin in mid-grey.
TEST_F(PreintegratedZoom, reads_an_image_of_curvature_around_its_value_of_flat_skin) {
    Scene scene = spheres_with_map();
    Renderer plain_renderer = make_renderer(scene);
    const DrawSettings settings = {.width = 32, .height = 32, .view = "diffuse"};
    const ParameterValues values = values_of({{"curvature", "image"}});
    const Image plain = radiance(plain_renderer, technique(), values, settings);
    for (SceneObject& object : scene.objects) {
        Material& skin = object.mesh.materials[0];
        skin.curvature_mid = 0.2f;
        skin.curvature_map.pixels = {std::byte(std::lround(
            255 * (0.2f + mean_curvature(object.mesh.curvatures_per_mm[0]) / skin.curvature_scale_per_mm) *
            0.5f))};
        skin.curvature_mid *= 0.5f;
        skin.curvature_scale_per_mm *= 2;
    }
    Renderer renderer = make_renderer(scene);
    EXPECT_LT(relative_difference(plain, radiance(renderer, technique(), values, settings), 1), 0.06);
}
