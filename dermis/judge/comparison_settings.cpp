// Settings of a comparison that follow from its size.

#include <algorithm>
#include <cmath>

#include "dermis/judge/comparison.h"
#include "dermis/render/renderer.h"

namespace dermis::inline judge {

int grid_of_size(int width, int height) {
    constexpr int kPointsAcross = 768;
    const int side = std::max({width, height, 1});
    return std::clamp((kPointsAcross + side - 1) / side, 2, 6);
}

double noise_of_size(int width, int height) {
    constexpr double kSmallNoise = 0.2, kSmallSide = 128;
    return kSmallNoise * std::max(std::sqrt(double(width) * height) / kSmallSide, 1.0);
}

ComparisonSettings comparison_settings(int width, int height) {
    ComparisonSettings settings{.width = width, .height = height, .grid = grid_of_size(width, height)};
    settings.reference = {.width = width,
                          .height = height,
                          .samples = 256,
                          .noise = 0.01,
                          .filter = PixelFilter::center,
                          .entry = LightEntry::all};
    settings.reference.lighting = {.ambient = AmbientModel::renderer,
                                   .specular = SpecularReflection::ggx,
                                   .penumbra_mm = DrawSettings{}.penumbra_mm};
    return settings;
}

}  // namespace dermis::inline judge
