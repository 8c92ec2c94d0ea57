#pragma once
// Small pictures for the tests of dermis/image, each texel different from its neighbours.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "dermis/image/image.h"

namespace dermis {

/// Smooth in x, steps in y, another phase for each channel; values in 0.05..0.95.
inline Image test_pattern(int width, int height, int channels) {
    Image image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                image.set(x, y, c,
                          0.5f + 0.45f * std::sin(0.7f * float(x) + 1.3f * float(y) + 2.0f * float(c)));
    return image;
}

inline float largest_difference(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height || a.channels != b.channels) return HUGE_VALF;
    const Image x = to_linear_float(a), y = to_linear_float(b);
    float largest = 0;
    for (size_t i = 0; i < x.floats().size(); ++i)
        largest = std::max(largest, std::abs(x.floats()[i] - y.floats()[i]));
    return largest;
}

}  // namespace dermis
