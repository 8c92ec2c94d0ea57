#include "dermis/scene/spherical_harmonics.h"

#include "dermis/base/angle.h"
#include "dermis/scene/panorama.h"

namespace dermis::inline scene {

std::array<float, 9> sh_basis(Vec3 d) {
    return {0.28209479f,
            0.48860251f * d.y,
            0.48860251f * d.z,
            0.48860251f * d.x,
            1.09254843f * d.x * d.y,
            1.09254843f * d.y * d.z,
            0.31539157f * (3 * d.z * d.z - 1),
            1.09254843f * d.x * d.z,
            0.54627422f * (d.x * d.x - d.y * d.y)};
}

RadianceSh project_radiance(const Image& panorama) {
    const std::span<const float> texels = panorama.floats();
    std::array<std::array<double, 3>, 9> sums = {};
    for (int y = 0; y < panorama.height; ++y) {
        const float solid_angle = panorama_texel_solid_angle(panorama, y);
        for (int x = 0; x < panorama.width; ++x) {
            const Vec3 d = panorama_direction((float(x) + 0.5f) / float(panorama.width),
                                              (float(y) + 0.5f) / float(panorama.height));
            const std::array<float, 9> basis = sh_basis(d);
            const float* radiance = &texels[3 * (size_t(y) * size_t(panorama.width) + size_t(x))];
            for (size_t i = 0; i < 9; ++i)
                for (size_t c = 0; c < 3; ++c) sums[i][c] += double(basis[i] * radiance[c] * solid_angle);
        }
    }
    RadianceSh sh;
    for (size_t i = 0; i < 9; ++i) sh[i] = {float(sums[i][0]), float(sums[i][1]), float(sums[i][2])};
    return sh;
}

Vec3 sh_irradiance(const RadianceSh& sh, Vec3 n) {
    constexpr float kBandWeight[9] = {kPi,     2 * kPi / 3, 2 * kPi / 3, 2 * kPi / 3, kPi / 4,
                                      kPi / 4, kPi / 4,     kPi / 4,     kPi / 4};
    const std::array<float, 9> basis = sh_basis(n);
    Vec3 sum;
    for (size_t i = 0; i < 9; ++i) sum += sh[i] * (kBandWeight[i] * basis[i]);
    return sum;
}

}  // namespace dermis::inline scene
