#pragma once
// Inside dermis/image only: what every metric does before it compares.

#include <array>
#include <span>
#include <vector>

#include "dermis/image/image.h"

namespace dermis::inline image::metrics {

/// One channel of a picture, row by row.
struct Plane {
    int width = 0, height = 0;
    std::vector<float> values;

    Plane() = default;
    Plane(int width_, int height_)
        : width(width_), height(height_), values(size_t(width_) * size_t(height_)) {}
    explicit Plane(const Image& map);
};

/// Both images in linear f32, checked as metrics.h says.
struct Pair {
    Image image, reference;
};
[[nodiscard]] Result<Pair> checked_pair(const Image& image, const Image& reference);
/// An error if the mask is neither empty nor of this size with one channel and at least one texel above 0.
[[nodiscard]] Result<void> check_mask(const Image& mask, int width, int height);

/// Red, green and blue clamped to 0..1, linear: what a display shows. One channel is grey.
[[nodiscard]] std::array<Plane, 3> display_planes(const Image& linear);

/// The number of channels that are compared: alpha is not.
[[nodiscard]] inline int compared_channels(const Image& image) {
    return image.channels == 4 ? 3 : image.channels;
}

/// Correlates rows (or columns) with a kernel of odd length; the border repeats outwards.
[[nodiscard]] Plane filter_rows(const Plane& plane, std::span<const float> kernel);
[[nodiscard]] Plane filter_columns(const Plane& plane, std::span<const float> kernel);

[[nodiscard]] Image to_image(Plane plane);

}  // namespace dermis::inline image::metrics
