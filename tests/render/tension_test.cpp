// The tension of a posed mesh in pictures: its debug view, and the wrinkle maps that it blends.

#include "dermis/mesh/tension.h"

#include <gmock/gmock.h>

#include <cmath>

#include "dermis/render/output.h"
#include "dermis/scene/pose_scene.h"
#include "image/test_images.h"
#include "render/grid_scene.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

constexpr DrawSettings kTensionView = {.width = kGrid, .height = kGrid, .view = "tension"};

// Tensions that differ from column to column of the grid's tiles.
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

// Stripes that lean by `lean` to the left and to the right, as unit vectors.
ImageSource stripes_of_normals(const std::string& name, double lean, int width_texels) {
    std::vector<std::byte> pixels;
    for (int i = 0; i < 64 * 64; ++i) {
        const double x = (i / width_texels) % 2 ? lean : -lean;
        for (const double value : {x, 0.0, std::sqrt(1 - x * x)})
            pixels.push_back(std::byte(std::lround(255 * (0.5 + 0.5 * value))));
    }
    return {.name = name, .width = 64, .height = 64, .channels = 3, .pixels = std::move(pixels)};
}

// Lit from the left at 45 degrees, as a normal map shows nothing in even light.
Scene evenly_tense_grid(float tension) {
    Scene scene = tense_grid();
    scene.objects[0].mesh.tensions.assign(scene.objects[0].mesh.positions_mm.size(), tension);
    scene.objects[0].mesh.materials[0].normal_map = stripes_of_normals("rest", 0.3, 4);
    scene.lights[0].to_light_world = normalize(Vec3{-1, 0, 1});
    return scene;
}

void add_wrinkle_maps(Scene& scene) {
    Material& material = scene.objects[0].mesh.materials[0];
    material.wrinkle_stretch_map = stripes_of_normals("stretch", 0.5, 8);
    material.wrinkle_compress_map = stripes_of_normals("compress", 0.7, 2);
}

class WrinklePicture : public TensionPicture {
  protected:
    // Of every technique but those whose normals are baked in the atlas, which the grid does not have.
    static Image drawn(const Scene& scene, const std::string& technique = "lambert") {
        Renderer renderer = make_renderer(scene);
        const Technique& drawn_by = built_in_technique(technique);
        ParameterValues values = small_map_values(drawn_by);
        if (technique == "preintegrated") EXPECT_TRUE(values.set("normals", "blended"));
        return radiance(renderer, drawn_by, values, {.width = kGrid, .height = kGrid, .deep = true});
    }
};

TEST_F(WrinklePicture, below_the_least_tension_is_that_without_maps_to_the_byte) {
    for (const float tension : {0.0f, 0.04f, -0.04f}) {
        Scene scene = evenly_tense_grid(tension);
        const Image without = drawn(scene);
        add_wrinkle_maps(scene);
        EXPECT_EQ(drawn(scene).bytes, without.bytes) << tension;
    }
    Scene rest = evenly_tense_grid(0);
    rest.objects[0].mesh.tensions.clear();
    const Image without = drawn(rest);
    add_wrinkle_maps(rest);
    EXPECT_EQ(drawn(rest).bytes, without.bytes) << "no stream of tensions";
}

TEST_F(WrinklePicture, above_the_full_tension_is_that_of_the_wrinkle_map_as_normal_map) {
    for (const std::string technique :
         {"lambert", "preintegrated", "texture_space", "screen_space_separable"})
        for (const float tension : {0.5f, -0.5f}) {
            Scene scene = evenly_tense_grid(tension);
            const Image rest = drawn(scene, technique);
            Material& material = scene.objects[0].mesh.materials[0];
            add_wrinkle_maps(scene);
            const Image wrinkled = drawn(scene, technique);
            material.normal_map = tension > 0 ? material.wrinkle_stretch_map : material.wrinkle_compress_map;
            material.wrinkle_stretch_map = material.wrinkle_compress_map = {};
            // Some devices round a mixture by the weight 1.
            EXPECT_LT(largest_difference(wrinkled, drawn(scene, technique)), 1e-5f)
                << technique << " " << tension;
            EXPECT_GT(largest_difference(wrinkled, rest), 1e-2f) << technique << " " << tension;
        }
}

TEST_F(WrinklePicture, of_a_targets_weight_of_1_is_that_of_the_wrinkle_map_as_normal_map) {
    for (const bool at_rest : {false, true})
        for (const std::string technique : {"lambert", "preintegrated"}) {
            Scene scene = evenly_tense_grid(0);
            if (at_rest) scene.objects[0].mesh.tensions.clear();
            const Image rest = drawn(scene, technique);
            add_wrinkle_maps(scene);
            Material& material = scene.objects[0].mesh.materials[0];
            material.wrinkle_stretch_target = "raise";
            scene.objects[0].target_weights = {{"raise", 0.0f}};
            EXPECT_EQ(drawn(scene, technique).bytes, rest.bytes) << technique << at_rest;
            scene.objects[0].target_weights = {{"raise", 1.0f}};
            const Image wrinkled = drawn(scene, technique);
            material.normal_map = material.wrinkle_stretch_map;
            material.wrinkle_stretch_map = material.wrinkle_compress_map = {};
            // Some devices round a mixture by the weight 1.
            EXPECT_LT(largest_difference(wrinkled, drawn(scene, technique)), 1e-5f) << technique << at_rest;
            EXPECT_GT(largest_difference(wrinkled, rest), 1e-2f) << technique << at_rest;
        }
}

TEST_F(WrinklePicture, of_one_map_ignores_the_other_sign) {
    for (const float tension : {0.5f, -0.5f}) {
        Scene scene = evenly_tense_grid(tension);
        const Image without = drawn(scene);
        add_wrinkle_maps(scene);
        Material& material = scene.objects[0].mesh.materials[0];
        (tension > 0 ? material.wrinkle_stretch_map : material.wrinkle_compress_map) = {};
        EXPECT_EQ(drawn(scene).bytes, without.bytes) << tension;
    }
}

TEST_F(WrinklePicture, of_a_grey_map_is_refused_in_one_line) {
    Scene scene = evenly_tense_grid(0.5f);
    scene.objects[0].mesh.materials[0].wrinkle_compress_map = {
        .name = "grey.png", .width = 1, .height = 1, .channels = 1, .pixels = {std::byte{128}}};
    const auto renderer =
        Renderer::create(device(), gpu::embedded_shaders(built_in_catalog().shaders), scene);
    ASSERT_FALSE(renderer);
    EXPECT_EQ(renderer.error().message, "grey.png: a normal map has red, green and blue");
}

}  // namespace
}  // namespace dermis
