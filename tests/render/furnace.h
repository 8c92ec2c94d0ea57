#pragma once
// A sphere that sees the same light from everywhere.

#include <algorithm>

#include "dermis/image/io.h"
#include "render/render_test.h"
#include "support/temporary_directory.h"

namespace dermis {

/// One sphere of `scene` that sees radiance 1 from everywhere.
[[nodiscard]] inline Scene sphere_in_furnace(Scene scene, const TemporaryDirectory& directory, float albedo) {
    scene.lights.clear();
    scene.objects.erase(scene.objects.begin(), scene.objects.begin() + 3);
    Mesh& mesh = scene.objects[0].mesh;
    mesh.materials[0].base_color_linear = {albedo, albedo, albedo};
    mesh.occlusions.assign(mesh.positions_mm.size(), 1.0f);
    Image white(64, 32, 3);
    std::ranges::fill(white.floats(), 1.0f);
    const auto panorama = directory.path / "white.exr";
    EXPECT_TRUE(write_image(panorama, white));
    scene.environment = {.kind = EnvironmentKind::file, .file = panorama, .intensity = 1};
    scene.background_linear = {};
    return scene;
}

/// Of the pixels that are covered whole.
[[nodiscard]] inline double largest_value(const Image& image) {
    double largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y, 3) == 1)
                for (int c = 0; c < 3; ++c) largest = std::max(largest, double(image.at(x, y, c)));
    return largest;
}

}  // namespace dermis
