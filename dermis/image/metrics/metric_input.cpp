#include "dermis/image/metrics/metric_input.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "dermis/base/parallel.h"

namespace dermis::inline image::metrics {
namespace {

std::string shape(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height) + " with " +
           std::to_string(image.channels) + " channels";
}

Result<void> check_finite(const Image& linear, const char* which) {
    const auto values = linear.floats();
    const auto it = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
    if (it == values.end()) return {};
    const size_t texel = size_t(it - values.begin()) / size_t(linear.channels);
    return Error{std::string("the ") + which + " holds " + (std::isnan(*it) ? "NaN" : "infinity") +
                 " at texel (" + std::to_string(texel % size_t(linear.width)) + ", " +
                 std::to_string(texel / size_t(linear.width)) + "); errors are of finite numbers"};
}

}  // namespace

Plane::Plane(const Image& map) : Plane(map.width, map.height) {
    assert(map.channels == 1);
    std::ranges::copy(map.floats(), values.begin());
}

Result<Pair> checked_pair(const Image& image, const Image& reference) {
    if (image.empty() || reference.empty()) return Error{"an empty image has no error"};
    if (image.width != reference.width || image.height != reference.height ||
        image.channels != reference.channels)
        return Error{"the image is " + shape(image) + ", the reference " + shape(reference) +
                     "; they must be of one size"};
    Pair pair{to_linear_float(image), to_linear_float(reference)};
    DERMIS_TRY(check_finite(pair.image, "image"));
    DERMIS_TRY(check_finite(pair.reference, "reference"));
    return pair;
}

Result<void> check_mask(const Image& mask, int width, int height) {
    if (mask.empty()) return {};
    if (mask.width != width || mask.height != height || mask.channels != 1)
        return Error{"the mask is " + shape(mask) + ", the image " + std::to_string(width) + "x" +
                     std::to_string(height) + "; a mask has one channel and the image's size"};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (mask.at(x, y, 0) > 0.0f) return {};
    return Error{"the mask covers no texel"};
}

std::array<Plane, 3> display_planes(const Image& linear) {
    const Plane plane(linear.width, linear.height);
    std::array<Plane, 3> planes = {plane, plane, plane};
    const size_t channels = size_t(linear.channels);
    parallel_for(linear.pixel_count(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            for (size_t c = 0; c < 3; ++c) {
                const bool missing = channels != 1 && c >= channels;
                const float value = missing ? 0.0f : linear.floats()[i * channels + (channels == 1 ? 0 : c)];
                planes[c].values[i] = std::clamp(value, 0.0f, 1.0f);
            }
    });
    return planes;
}

Plane filter_rows(const Plane& plane, std::span<const float> kernel) {
    Plane out(plane.width, plane.height);
    const size_t width = size_t(plane.width), reach = kernel.size() / 2;
    parallel_for(size_t(plane.height), 16, [&](size_t begin, size_t end) {
        std::vector<float> padded(width + 2 * reach);
        for (size_t y = begin; y < end; ++y) {
            const float* row = plane.values.data() + y * width;
            std::fill_n(padded.begin(), reach, row[0]);
            std::copy_n(row, width, padded.begin() + std::ptrdiff_t(reach));
            std::fill_n(padded.end() - std::ptrdiff_t(reach), reach, row[width - 1]);
            float* to = out.values.data() + y * width;
            for (size_t k = 0; k < kernel.size(); ++k)
                for (size_t x = 0; x < width; ++x) to[x] += kernel[k] * padded[x + k];
        }
    });
    return out;
}

Plane filter_columns(const Plane& plane, std::span<const float> kernel) {
    Plane out(plane.width, plane.height);
    const size_t width = size_t(plane.width);
    const int reach = int(kernel.size() / 2);
    parallel_for(size_t(plane.height), 16, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            float* to = out.values.data() + y * width;
            for (int k = -reach; k <= reach; ++k) {
                const size_t source = size_t(std::clamp(int(y) + k, 0, plane.height - 1));
                const float weight = kernel[size_t(k + reach)];
                const float* row = plane.values.data() + source * width;
                for (size_t x = 0; x < width; ++x) to[x] += weight * row[x];
            }
        }
    });
    return out;
}

Image to_image(Plane plane) {
    Image image(plane.width, plane.height, 1);
    std::ranges::copy(plane.values, image.floats().begin());
    return image;
}

}  // namespace dermis::inline image::metrics
