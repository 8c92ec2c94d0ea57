#pragma once
// A small scene drawn by any technique, under validation.

#include "dermis/render/complete_scene.h"
#include "dermis/render/renderer.h"
#include "dermis/technique/gain.h"
#include "support/built_in.h"
#include "support/gpu_fixture.h"

namespace dermis {

class RenderTest : public gpu::GpuTest {
  protected:
    static Scene load(const std::string& name) {
        Result<Scene> scene = load_built_in_scene(name);
        EXPECT_TRUE(scene) << scene.error().message;
        EXPECT_TRUE(complete_scene(*scene));
        return std::move(*scene);
    }

    /// White spheres that see the same light everywhere: no key, no occlusion, one normal.
    static Scene evenly_lit_spheres() {
        Scene scene = load("builtin:spheres");
        scene.lights.clear();
        for (SceneObject& object : scene.objects) {
            object.mesh.materials[0].base_color_linear = {1, 1, 1};
            object.mesh.occlusions.assign(object.mesh.positions_mm.size(), 1.0f);
            for (Vec3& n : object.mesh.normals) n = {0, 1, 0};
        }
        return scene;
    }

    static Renderer make_renderer(const Scene&&) = delete;
    static Renderer make_renderer(const Scene& scene) {
        Result<Renderer> renderer =
            Renderer::create(device(), gpu::embedded_shaders(built_in_catalog().shaders), scene);
        EXPECT_TRUE(renderer) << renderer.error().message;
        return std::move(*renderer);
    }

    /// The defaults, but for a light map that the small pictures of tests do not outgrow: most of the time of
    /// a test that draws every technique would go into maps of 1024 x 1024 texels.
    static ParameterValues small_map_values(const Technique& technique) {
        ParameterValues values(technique.parameters);
        if (technique.parameters.find("light_map_size")) EXPECT_TRUE(values.set("light_map_size", "256"));
        return values;
    }

    /// The same with the light that the profile describes alone.
    static ParameterValues profile_values(const Technique& technique) {
        return without_gain(small_map_values(technique));
    }

    /// Linear radiance of one frame with small_map_values(), as floats.
    static Image radiance(Renderer& renderer, const Technique& technique, const DrawSettings& settings) {
        return radiance(renderer, technique, small_map_values(technique), settings);
    }
    static Image radiance(Renderer& renderer, const Technique& technique, const ParameterValues& values,
                          const DrawSettings& settings) {
        const Result<gpu::FrameResult> drawn = renderer.draw(technique, values, settings);
        EXPECT_TRUE(drawn) << technique.id << ": " << drawn.error().message;
        Result<Image> image = renderer.radiance();
        EXPECT_TRUE(image) << image.error().message;
        return to_linear_float(*image);
    }

    /// Largest |a * factor - b| of any colour channel over the pixels that a covers (alpha 1), relative to
    /// the mean of b.
    static double relative_difference(const Image& a, const Image& b, double factor) {
        double largest = 0, sum = 0;
        size_t count = 0;
        for (int y = 0; y < a.height; ++y)
            for (int x = 0; x < a.width; ++x) {
                if (a.at(x, y, 3) == 0) continue;
                for (int c = 0; c < 3; ++c) {
                    largest = std::max(largest, std::abs(a.at(x, y, c) * factor - b.at(x, y, c)));
                    sum += b.at(x, y, c);
                    ++count;
                }
            }
        EXPECT_GT(count, 100u) << "nothing was drawn";
        return largest / std::max(sum / double(count), 1e-9);
    }
};

}  // namespace dermis
