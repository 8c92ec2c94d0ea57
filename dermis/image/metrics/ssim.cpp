// Structural similarity, Wang, Bovik, Sheikh and Simoncelli 2004. Means, variances and the covariance under a
// Gaussian window (equations 14 to 16) are five filtered pictures; equation 13 combines them
// texel by texel.

#include <cmath>
#include <functional>

#include "dermis/image/colour.h"
#include "dermis/image/metrics.h"
#include "dermis/image/metrics/metric_input.h"

namespace dermis::inline image {
namespace {

using metrics::Plane;

constexpr int kReach = 5;  // an 11x11 window
constexpr double kSigma = 1.5;
constexpr float kC1 = 0.01f * 0.01f, kC2 = 0.03f * 0.03f;  // (K L)^2 with L = 1

std::vector<float> window() {
    std::vector<double> weights;
    double sum = 0;
    for (int i = -kReach; i <= kReach; ++i) {
        weights.push_back(std::exp(-i * i / (2 * kSigma * kSigma)));
        sum += weights.back();
    }
    std::vector<float> kernel;
    for (const double weight : weights) kernel.push_back(float(weight / sum));
    return kernel;
}

// BT.601 luma of sRGB codes, as the authors' own program converts colour pictures.
Plane luma(const Image& linear) {
    std::array<Plane, 3> rgb = metrics::display_planes(linear);
    Plane out(linear.width, linear.height);
    for (size_t i = 0; i < out.values.size(); ++i)
        out.values[i] = 0.299f * srgb_encode(rgb[0].values[i]) + 0.587f * srgb_encode(rgb[1].values[i]) +
                        0.114f * srgb_encode(rgb[2].values[i]);
    return out;
}

constexpr float kShift = 0.5f;

Plane shifted(Plane plane) {
    for (float& value : plane.values) value -= kShift;
    return plane;
}

Plane product(const Plane& a, const Plane& b) {
    Plane out(a.width, a.height);
    for (size_t i = 0; i < out.values.size(); ++i) out.values[i] = a.values[i] * b.values[i];
    return out;
}

}  // namespace

Result<Image> ssim_map(const Image& image, const Image& reference) {
    DERMIS_TRY_ASSIGN(const metrics::Pair pair, metrics::checked_pair(image, reference));
    const std::vector<float> kernel = window();
    const auto mean = [&](const Plane& p) { return filter_columns(filter_rows(p, kernel), kernel); };
    // A shift does not change variances, but it reduces rounding: E[x^2] - E[x]^2 is most exact around 0.
    const Plane x = shifted(luma(pair.image)), y = shifted(luma(pair.reference));
    const Plane mu_x = mean(x), mu_y = mean(y);
    const Plane xx = mean(product(x, x)), yy = mean(product(y, y)), xy = mean(product(x, y));
    Image map(image.width, image.height, 1);
    for (size_t i = 0; i < x.values.size(); ++i) {
        const float sx = mu_x.values[i], sy = mu_y.values[i];
        const float var_x = xx.values[i] - sx * sx, var_y = yy.values[i] - sy * sy;
        const float covariance = xy.values[i] - sx * sy;
        const float mx = sx + kShift, my = sy + kShift;
        map.floats()[i] = (2 * mx * my + kC1) * (2 * covariance + kC2) /
                          ((mx * mx + my * my + kC1) * (var_x + var_y + kC2));
    }
    return map;
}

Result<double> ssim(const Image& image, const Image& reference, const Image& mask) {
    DERMIS_TRY_ASSIGN(const Image map, ssim_map(image, reference));
    DERMIS_TRY(metrics::check_mask(mask, image.width, image.height));
    // The border, where the window leaves the image, is taken out of the mask.
    const int border = image.width > 2 * kReach && image.height > 2 * kReach ? kReach : 0;
    Image inner(image.width, image.height, 1);
    for (int y = border; y < image.height - border; ++y)
        for (int x = border; x < image.width - border; ++x)
            inner.set(x, y, 0, mask.empty() || mask.at(x, y, 0) > 0.0f ? 1.0f : 0.0f);
    // A mask inside the border only is measured on the repeated border.
    return metrics::check_mask(inner, image.width, image.height) ? mean_of(map, inner) : mean_of(map, mask);
}

}  // namespace dermis::inline image
