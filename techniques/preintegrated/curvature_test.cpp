// Surfaces whose curvature is not the same in all directions.

#include <gtest/gtest.h>

#include "dermis/mesh/curvature.h"
#include "dermis/mesh/mesh.h"
#include "dermis/optics/preintegration.h"
#include "dermis/rays/map_file.h"
#include "judge/exact_shares.h"
#include "render/grid_scene.h"

using namespace dermis;

namespace {

// The grid as if every tile lay on a surface that bends by `across` times the tile's curvature in the plane
// of the light and by `along` times it at right angles.
Scene bent_grid(float across, float along) {
    Scene scene = make_grid_scene();
    Mesh& mesh = scene.objects[0].mesh;
    for (size_t i = 0; i < mesh.normals.size(); ++i) {
        const Vec3 n = mesh.normals[i];
        const float k = mean_curvature(mesh.curvatures_per_mm[i]);
        // In the plane of the light the direction is (-n.y, n.x, 0), at right angles to it z.
        mesh.curvatures_per_mm[i] = tangent_curvature({-n.y, n.x, 0}, {0, 0, 1}, k * across, k * along);
    }
    return scene;
}

class PreintegratedCurvature : public PreintegratedTest {
  protected:
    // Largest red difference over the tiles with radii from 2 mm.
    static double largest_difference(const Scene& scene, const Preintegration& how) {
        const Image image = draw_grid(scene, {{"shadow", "plain"}});
        double largest = 0;
        for (int y = 0; y < kGrid && grid_curvature_per_mm(y) <= 0.5; ++y)
            for (int x = 0; x < kGrid; ++x) {
                const double t = grid_cosine(x);
                const Rgb d = preintegrated_diffuse(gpu_gems_3_skin(), t, 1 / grid_curvature_per_mm(y), how);
                largest = std::max(largest, std::abs(d[0] - double(image.at(x, y, 0))));
            }
        return largest;
    }
};

}  // namespace

// A Gaussian on a cylinder is a Gaussian along it times one around it, so that light from the side is exactly
// the full ring's with Gaussians as lines.
TEST_F(PreintegratedCurvature, of_a_cylinder_lit_from_its_side_is_near_the_ring) {
    const double difference = largest_difference(bent_grid(1, 0), {.construction = Construction::full_ring});
    RecordProperty("difference", std::to_string(difference));
    EXPECT_LT(difference, 0.04);
}

// Around the axis N.L stays the same, and nothing is blurred.
TEST_F(PreintegratedCurvature, of_a_cylinder_lit_along_its_axis_is_lamberts_at_the_terminator) {
    const Image image = draw_grid(bent_grid(0, 1), {{"shadow", "plain"}});
    for (int y = 0; y < kGrid; ++y)
        for (int x = kGrid / 2 - 2; x < kGrid / 2 + 2; ++x)
            EXPECT_NEAR(image.at(x, y, 0), std::max(grid_cosine(x), 0.0), 0.012) << x << " " << y;
}

// Mean curvature 0: folds of the ear, of the neck, and between nose and cheek have lines of such points.
TEST_F(PreintegratedCurvature, of_a_saddle_is_that_of_a_sphere_with_its_curvature) {
    EXPECT_LT(largest_difference(bent_grid(1, -1), {}), 1e-3);
}

TEST_F(PreintegratedCurvature, of_a_concave_surface_is_that_of_the_convex_one) {
    EXPECT_LT(largest_difference(bent_grid(-1, -1), {}), 1e-3);
}

// A saddle has no mean curvature, but bends: a map of the mean leaves it unscattered and says so.
TEST_F(PreintegratedCurvature, of_a_baked_map_is_that_of_the_vertices_and_a_grey_map_says_what_it_lacks) {
    Scene scene = unit_case("saddle").scene;
    ASSERT_TRUE(complete_scene(scene));
    const BakeMapSettings settings = {.size = 128, .smoothing_mm = float(kCurvatureSmoothingMm)};
    const Result<BakedMap> map = bake_map(scene.objects, settings);
    ASSERT_TRUE(map) << map.error().message;
    const std::string path = (std::filesystem::path(testing::TempDir()) / "dermis_saddle.exr").string();
    ASSERT_TRUE(write_map(path, *map, {"saddle", settings}));
    BakedMap mean = *map;
    mean.values = single_channel(map->values, 0);
    const std::string mean_path = (std::filesystem::path(testing::TempDir()) / "dermis_mean.exr").string();
    ASSERT_TRUE(write_map(mean_path, mean, {"saddle", settings}));

    std::vector<std::string> warnings;
    const auto drawn = [&](const char* curvature, const std::string& file) {
        scene.objects[0].mesh.materials[0].curvature_map = {.name = file};
        Renderer renderer = make_renderer(scene);
        const Image image =
            radiance(renderer, technique(), values_of({{"curvature", curvature}, {"normals", "sharp"}}),
                     {.width = 64, .height = 64, .view = "diffuse"});
        warnings = renderer.warnings();
        return image;
    };
    const Image vertex = drawn("vertex", ""), image = drawn("image", path);
    EXPECT_TRUE(warnings.empty());
    EXPECT_LT(relative_difference(vertex, image, 1), 0.01);
    EXPECT_GT(relative_difference(vertex, drawn("image", mean_path), 1), 0.05);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("dermis_mean.exr: holds mean curvature only"), std::string::npos);
}
