#pragma once
// A browser's picture of a sphere against the renderer's.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "dermis/image/image.h"

namespace dermis {

/// Pixels on the sphere, more than two pixels from its edge: a browser smooths edges, the renderer's picture
/// has one sample a pixel. The upper left pixel of the picture is background.
class SpherePixels {
  public:
    explicit SpherePixels(const Image& picture) : picture_(picture) {}
    [[nodiscard]] bool is_inside(int x, int y) const {
        if (std::min(x, y) < kEdge || x >= picture_.width - kEdge || y >= picture_.height - kEdge)
            return false;
        for (int dy = -kEdge; dy <= kEdge; ++dy)
            for (int dx = -kEdge; dx <= kEdge; ++dx)
                if (is_background(x + dx, y + dy)) return false;
        return true;
    }

  private:
    static constexpr int kEdge = 2;
    [[nodiscard]] bool is_background(int x, int y) const {
        for (int c = 0; c < 3; ++c)
            if (picture_.at(x, y, c) != picture_.at(0, 0, c)) return false;
        return true;
    }
    const Image& picture_;
};

/// Of 255, the largest over all channels.
inline int level_difference(const Image& a, const Image& b, int x, int y) {
    const auto level = [&](const Image& image, int c) { return int(std::lround(image.at(x, y, c) * 255)); };
    int largest = 0;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(level(a, c) - level(b, c)));
    return largest;
}

struct SphereDifference {
    int pixels = 0;
    int largest_level = 0;  ///< of 255, over all channels
};

/// Both pictures have the same size.
inline SphereDifference sphere_difference(const Image& ours, const Image& theirs) {
    const SpherePixels sphere(ours);
    SphereDifference found;
    for (int y = 0; y < ours.height; ++y)
        for (int x = 0; x < ours.width; ++x) {
            if (!sphere.is_inside(x, y)) continue;
            ++found.pixels;
            found.largest_level = std::max(found.largest_level, level_difference(ours, theirs, x, y));
        }
    return found;
}

}  // namespace dermis
