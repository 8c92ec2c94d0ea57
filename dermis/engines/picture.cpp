#include "dermis/engines/picture.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/io.h"

namespace dermis::inline engines::packages {
namespace {

constexpr int kSide = 160, kColumns = 3, kRows = 2, kSamples = 3;
constexpr double kRadiiMm[kColumns] = {4, 8, 16};
constexpr double kToLight[3] = {0.88, 0.32, 0.35};  // normalised to 1 %, as the picture is
constexpr Rgb kAlbedo = {0.48, 0.19, 0.11}, kBackground = {0.02, 0.02, 0.02};

// One place of a sphere's square, -1 to 1 across it.
Rgb shaded(const Table& table, int column, int row, double x, double y) {
    const double z2 = 1 - (x * x + y * y) / (0.9 * 0.9);
    if (z2 < 0) return kBackground;
    const double n_dot_l = (x * kToLight[0] - y * kToLight[1]) / 0.9 + std::sqrt(z2) * kToLight[2];
    const double lambert = std::max(n_dot_l, 0.0);
    Rgb light = {lambert, lambert, lambert};
    if (row == 0) light = lookup(table, std::clamp(n_dot_l, -1.0, 1.0), 1 / kRadiiMm[column]);
    for (size_t c = 0; c < 3; ++c) light[c] *= kAlbedo[c];
    return light;
}

}  // namespace

Result<std::vector<std::byte>> picture_of(const Table& table) {
    Image image(kColumns * kSide, kRows * kSide, 3, PixelFormat::f32, Encoding::linear);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            Rgb sum = {0, 0, 0};
            for (int i = 0; i < kSamples * kSamples; ++i) {
                const double u = (x % kSide + (i % kSamples + 0.5) / kSamples) / kSide;
                const double v = (y % kSide + (i / kSamples + 0.5) / kSamples) / kSide;
                const Rgb value = shaded(table, x / kSide, y / kSide, 2 * u - 1, 2 * v - 1);
                for (size_t c = 0; c < 3; ++c) sum[c] += value[c] / (kSamples * kSamples);
            }
            for (int c = 0; c < 3; ++c) image.set(x, y, c, float(sum[size_t(c)]));
        }
    return encode_image(".png", image);
}

}  // namespace dermis::inline engines::packages
