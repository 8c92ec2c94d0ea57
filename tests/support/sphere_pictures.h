#pragma once
// A browser's picture of a sphere against the renderer's.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "dermis/image/image.h"

namespace dermis {

/// Of the pixels on the sphere, more than two pixels from its edge: a browser smooths edges, the renderer's
/// picture has one sample a pixel.
struct SphereDifference {
    int pixels = 0;
    int largest_level = 0;  ///< of 255, over all channels
};

/// The upper left pixel of `ours` is background. Both pictures have the same size.
inline SphereDifference sphere_difference(const Image& ours, const Image& theirs) {
    constexpr int kEdge = 2;
    const auto level = [](const Image& image, int x, int y, int c) {
        return int(std::lround(image.at(x, y, c) * 255));
    };
    const auto is_background = [&](int x, int y) {
        for (int c = 0; c < 3; ++c)
            if (level(ours, x, y, c) != level(ours, 0, 0, c)) return false;
        return true;
    };
    const auto is_inside = [&](int x, int y) {
        for (int dy = -kEdge; dy <= kEdge; ++dy)
            for (int dx = -kEdge; dx <= kEdge; ++dx)
                if (is_background(x + dx, y + dy)) return false;
        return true;
    };
    SphereDifference found;
    for (int y = kEdge; y < ours.height - kEdge; ++y)
        for (int x = kEdge; x < ours.width - kEdge; ++x) {
            if (!is_inside(x, y)) continue;
            ++found.pixels;
            for (int c = 0; c < 3; ++c)
                found.largest_level =
                    std::max(found.largest_level, std::abs(level(ours, x, y, c) - level(theirs, x, y, c)));
        }
    return found;
}

}  // namespace dermis
