// Wrinkle maps of a posed mesh: the renderer and the reference show the same normals.

#include <cmath>
#include <numbers>

#include "dermis/base/file.h"
#include "dermis/rays/camera_ray.h"
#include "dermis/reference/materials.h"
#include "dermis/render/output.h"
#include "render/render_test.h"
#include "support/built_in.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

constexpr int kWrinkleSide = 96;

// Waves along u and v that lean by up to `lean`, wide enough for both filters to agree.
ImageSource waves(const std::string& name, double lean, int count, int side = 64) {
    std::vector<std::byte> pixels;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto wave = [&](int i) {
                return lean * std::sin(2 * std::numbers::pi * count * (i + 0.5) / side);
            };
            const double nx = wave(x), ny = 0.5 * wave(y);
            for (const double value : {nx, ny, std::sqrt(1 - nx * nx - ny * ny)})
                pixels.push_back(std::byte(std::lround(255 * (0.5 + 0.5 * value))));
        }
    return {.name = name, .width = side, .height = side, .channels = 3, .pixels = std::move(pixels)};
}

class Wrinkles : public RenderTest {
  protected:
    // `lift`: 1 stretches the middle, -1 compresses it.
    Scene sheet(const std::string& lift) const {
        const auto path = directory_.path / "sheet.gltf";
        EXPECT_TRUE(write_text_file(path, test::moving_sheet()));
        auto loaded = load_scene(path.string(), {.words = {{"morph.lift", lift}}});
        EXPECT_TRUE(loaded) << loaded.error().message;
        Material& material = loaded->objects[0].mesh.materials[0];
        material.normal_map = waves("rest", 0.2, 3);
        material.wrinkle_stretch_map = waves("stretch", 0.5, 3, 48);
        material.wrinkle_compress_map = waves("compress", 0.6, 4);
        material.wrinkle_from = 0.02f, material.wrinkle_full = 0.06f;
        EXPECT_TRUE(complete_scene(*loaded));
        return std::move(*loaded);
    }

    static Image drawn_normals(const Scene& scene) {
        Renderer renderer = make_renderer(scene);
        const Technique& technique = built_in_technique("lambert");
        const DrawSettings draw = {
            .width = kWrinkleSide, .height = kWrinkleSide, .samples = 1, .view = "normal"};
        EXPECT_TRUE(renderer.draw(technique, ParameterValues(technique.parameters), draw));
        const Result<Image> numbers = linear_picture(renderer, "normal");
        EXPECT_TRUE(numbers) << numbers.error().message;
        return *numbers;
    }
    TemporaryDirectory directory_;
};

struct Agreement {
    double largest = 0;                              // difference of two normals
    size_t pixels = 0, none = 0, part = 0, all = 0;  // by the share of the wrinkle map
};

Agreement agreement(const Scene& scene, const Image& drawn) {
    const auto materials = MaterialSet::load(scene);
    const auto rays = RayScene::build(scene.objects);
    EXPECT_TRUE(materials && rays);
    const Mat4 inverse_view_projection = camera_matrices(scene.camera, 1).inverse_view_projection;
    const Material& material = scene.objects[0].mesh.materials[0];
    Agreement found;
    for (int y = 0; y < kWrinkleSide; ++y)
        for (int x = 0; x < kWrinkleSide; ++x) {
            const Ray ray = camera_ray(inverse_view_projection, float(x) + 0.5f, float(y) + 0.5f,
                                       kWrinkleSide, kWrinkleSide);
            const Vec3 n = {drawn.at(x, y, 0), drawn.at(x, y, 1), drawn.at(x, y, 2)};
            const auto hit = rays->closest_hit(RaySet::opaque, ray);
            if (!hit || dot(n, n) < 0.5f) continue;
            const SurfaceAttributes at = rays->surface_at(*hit);
            found.largest =
                std::max(found.largest, double(length(materials->normal_at(at, hit->object) - n)));
            const float size = std::abs(at.tension);
            ++(size < material.wrinkle_from   ? found.none
               : size < material.wrinkle_full ? found.part
                                              : found.all);
            ++found.pixels;
        }
    return found;
}

}  // namespace

// The two wrinkle maps have two sizes.
TEST_F(Wrinkles, have_the_same_normals_in_the_renderer_and_in_the_reference) {
    for (const char* lift : {"1", "-1"}) {
        Scene scene = sheet(lift);
        const Image drawn = drawn_normals(scene);
        const Agreement same = agreement(scene, drawn);
        EXPECT_LT(same.largest, 0.02) << lift;
        EXPECT_GT(same.pixels, 2000u);
        EXPECT_GT(std::min({same.none, same.part, same.all}), 100u)
            << lift << ": " << same.none << " " << same.part << " " << same.all;
        for (Material& material : scene.objects[0].mesh.materials)
            material.wrinkle_stretch_map = material.wrinkle_compress_map = {};
        EXPECT_GT(agreement(scene, drawn).largest, 0.2) << lift << ": without the maps";
    }
}

// Stretched skin has a share of the map for compressed skin, too.
TEST_F(Wrinkles, by_target_have_the_same_normals_in_the_renderer_and_in_the_reference) {
    Scene scene = sheet("0.6");
    scene.objects[0].mesh.materials[0].wrinkle_compress_target = "lift";
    const Image drawn = drawn_normals(scene);
    EXPECT_LT(agreement(scene, drawn).largest, 0.02);
    scene.objects[0].target_weights.clear();
    EXPECT_GT(agreement(scene, drawn).largest, 0.2) << "by tension alone";
}
