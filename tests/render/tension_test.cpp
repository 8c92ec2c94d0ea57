// The tension of a posed mesh in pictures: its debug view and its layer.

#include "dermis/mesh/tension.h"

#include <gmock/gmock.h>

#include <cmath>

#include "dermis/render/output.h"
#include "dermis/scene/pose_scene.h"
#include "render/grid_scene.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

constexpr DrawSettings kTensionView = {.width = kGrid, .height = kGrid, .view = "tension"};

// Of the column x of the grid's tiles.
float tension_of_column(int x) {
    return 0.8f * float(grid_cosine(x));
}

// The grid facing the camera, with a tension for each column of tiles.
Scene tense_grid() {
    Scene scene = make_grid_scene();
    Mesh& mesh = scene.objects[0].mesh;
    for (size_t v = 0; v < mesh.positions_mm.size(); ++v) {
        mesh.normals[v] = {0, 0, 1};
        mesh.tangents[v] = {1, 0, 0, 1};
        mesh.tensions.push_back(tension_of_column(int(v / 4) % kGrid));
    }
    return scene;
}

class TensionPicture : public GridTest {
  protected:
    static Image tension_view(Renderer& renderer) {
        const Technique& technique = built_in_technique("lambert");
        const auto drawn = renderer.draw(technique, ParameterValues(technique.parameters), kTensionView);
        EXPECT_TRUE(drawn) << drawn.error().message;
        const Result<Image> numbers = linear_picture(renderer, "tension");
        EXPECT_TRUE(numbers) << numbers.error().message;
        return *numbers;
    }
};

TEST_F(TensionPicture, the_view_shows_that_of_the_vertices) {
    const Scene scene = tense_grid();
    Renderer renderer = make_renderer(scene);
    const Image numbers = tension_view(renderer);
    for (int x = 0; x < kGrid; ++x) EXPECT_NEAR(numbers.at(x, kGrid / 2, 0), tension_of_column(x), 1e-5f);
}

TEST_F(TensionPicture, a_scene_at_rest_has_no_stream_and_a_view_of_zeros) {
    Scene scene = tense_grid();
    scene.objects[0].mesh.tensions.clear();
    Renderer renderer = make_renderer(scene);
    EXPECT_FALSE(renderer.has_tension());
    const Image numbers = tension_view(renderer);
    for (int x = 0; x < kGrid; ++x) EXPECT_EQ(numbers.at(x, kGrid / 2, 0), 0);
    for (const Pass& pass : renderer.list().passes) EXPECT_EQ(pass.vertex_shader, "") << pass.name;

    scene.objects[0].motion.clips.resize(1);
    scene.objects[0].mesh.tensions.assign(scene.objects[0].mesh.positions_mm.size(), 0.25f);
    ASSERT_TRUE(renderer.vertices_moved()) << "it begins to move";
    EXPECT_NEAR(tension_view(renderer).at(kGrid / 2, kGrid / 2, 0), 0.25f, 1e-6f);
}

TEST_F(TensionPicture, layers_have_it_beside_the_curvature_in_a_pose_alone) {
    const TemporaryDirectory directory;
    const Technique& technique = built_in_technique("lambert");
    const ParameterValues values(technique.parameters);
    Scene scene = tense_grid();
    for (const bool posed : {true, false}) {
        if (!posed) scene.objects[0].mesh.tensions.clear();
        Renderer renderer = make_renderer(scene);
        const DrawSettings draw = {.width = kGrid, .height = kGrid};
        ASSERT_TRUE(renderer.draw(technique, values, draw));
        const auto path = directory.path / "layers.exr";
        ASSERT_TRUE(write_output(renderer, technique, values, draw, path, {.layers = true}));
        const Result<std::string> file = read_text_file(path);
        ASSERT_TRUE(file);
        EXPECT_NE(file->find("curvature_per_mm"), std::string::npos);
        EXPECT_EQ(file->find("tension") != std::string::npos, posed);
    }
}

}  // namespace
}  // namespace dermis
