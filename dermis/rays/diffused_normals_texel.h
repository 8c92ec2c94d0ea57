#pragma once
// How DiffusedNormals holds a mean normal and the spread of normals around it. Internal to dermis/rays.

#include <algorithm>

#include "dermis/image/dilate.h"
#include "dermis/rays/diffused_normals.h"

namespace dermis::inline rays {

/// The axes x and z across a unit mean that the spread refers to, as in
/// techniques/preintegrated/diffused_normals.glsl.
struct SpreadFrame {
    Vec3 x, z;
    explicit SpreadFrame(Vec3 n) {
        const float a = 1 / std::max(1 + n.y, 1e-4f), b = -n.x * n.z * a;
        x = {1 - n.x * n.x * a, -n.x, b};
        z = {b, -n.z, 1 - n.z * n.z * a};
    }
};

[[nodiscard]] inline uint16_t encoded_part(float x) {
    return uint16_t(std::clamp(x * 0.5f + 0.5f, 0.0f, 1.0f) * 65535 + 0.5f);
}
[[nodiscard]] inline float decoded_part(uint16_t x) {
    return float(x) * (2 / 65535.0f) - 1;
}

/// Grows the charts into their gutter, then encodes. Images: f32, four channels; coverage: above 0 on skin.
[[nodiscard]] inline DiffusedNormals encoded_normals(Image red, Image green, const Image& coverage) {
    DiffusedNormals made{.size = red.width, .red = {}, .green = {}};
    const auto encode = [&](Image& image, std::vector<DiffusedNormals::Texel>& texels) {
        dilate(image, coverage, kDiffusedNormalsGutter);
        texels.resize(image.pixel_count());
        for (size_t i = 0; i < texels.size(); ++i)
            for (size_t c = 0; c < 4; ++c) texels[i][c] = encoded_part(image.floats()[4 * i + c]);
    };
    encode(red, made.red);
    encode(green, made.green);
    return made;
}

}  // namespace dermis::inline rays
