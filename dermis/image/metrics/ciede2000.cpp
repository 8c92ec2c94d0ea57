// CIEDE2000. Sharma, Wu and Dalal 2005; the numbers in brackets are their equations.

#include <cmath>
#include <numbers>

#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"
#include "dermis/image/metrics.h"
#include "dermis/image/metrics/metric_input.h"

namespace dermis::inline image {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double k25To7 = 6103515625.0;

double power7(double x) {
    const double x3 = x * x * x;
    return x3 * x3 * x;
}

// In degrees, 0 to 360; 0 for a grey. [7]
double hue_of(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double h = std::atan2(b, a) / kDegree;
    return h < 0 ? h + 360.0 : h;
}

// Along the shorter arc. [10]
double hue_difference(double h1, double h2, bool grey) {
    if (grey) return 0;
    const double d = h2 - h1;
    return d > 180.0 ? d - 360.0 : d < -180.0 ? d + 360.0 : d;
}

// On the shorter arc. [14]
double mean_hue(double h1, double h2, bool grey) {
    const double sum = h1 + h2;
    if (grey) return sum;
    if (std::abs(h1 - h2) <= 180.0) return sum / 2;
    return sum < 360.0 ? (sum + 360.0) / 2 : (sum - 360.0) / 2;
}

}  // namespace

double ciede2000(Vec3 lab_a, Vec3 lab_b) {
    const double L1 = lab_a.x, a1 = lab_a.y, b1 = lab_a.z, L2 = lab_b.x, a2 = lab_b.y, b2 = lab_b.z;
    // Chroma and hue, with a stretched for colours near grey. [2-7]
    const double mean_chroma7 = power7((std::hypot(a1, b1) + std::hypot(a2, b2)) / 2);
    const double stretch = 1.0 + 0.5 * (1.0 - std::sqrt(mean_chroma7 / (mean_chroma7 + k25To7)));
    const double a1s = stretch * a1, a2s = stretch * a2;
    const double C1 = std::hypot(a1s, b1), C2 = std::hypot(a2s, b2);
    const double h1 = hue_of(a1s, b1), h2 = hue_of(a2s, b2);
    const bool grey = C1 * C2 == 0;

    // Differences in lightness, chroma and hue. [8-11]
    const double dL = L2 - L1, dC = C2 - C1;
    const double dH = 2.0 * std::sqrt(C1 * C2) * std::sin(hue_difference(h1, h2, grey) / 2 * kDegree);

    // Weights by the mean colour. [12-21]
    const double L = (L1 + L2) / 2, C = (C1 + C2) / 2, h = mean_hue(h1, h2, grey);
    const double T = 1.0 - 0.17 * std::cos((h - 30.0) * kDegree) + 0.24 * std::cos(2.0 * h * kDegree) +
                     0.32 * std::cos((3.0 * h + 6.0) * kDegree) - 0.20 * std::cos((4.0 * h - 63.0) * kDegree);
    const double blue = (h - 275.0) / 25.0, rotation = 30.0 * std::exp(-blue * blue);
    const double R_C = 2.0 * std::sqrt(power7(C) / (power7(C) + k25To7));
    const double off_grey = (L - 50.0) * (L - 50.0);
    const double S_L = 1.0 + 0.015 * off_grey / std::sqrt(20.0 + off_grey);
    const double S_C = 1.0 + 0.045 * C, S_H = 1.0 + 0.015 * C * T;
    const double R_T = -std::sin(2.0 * rotation * kDegree) * R_C;

    const double l = dL / S_L, c = dC / S_C, H = dH / S_H;
    return std::sqrt(std::max(0.0, l * l + c * c + H * H + R_T * c * H));  // [22]
}

Result<Image> ciede2000_map(const Image& image, const Image& reference) {
    DERMIS_TRY_ASSIGN(const metrics::Pair pair, metrics::checked_pair(image, reference));
    const auto a = metrics::display_planes(pair.image), b = metrics::display_planes(pair.reference);
    const auto lab = [](const std::array<metrics::Plane, 3>& rgb, size_t i) {
        return lab_from_linear({rgb[0].values[i], rgb[1].values[i], rgb[2].values[i]});
    };
    Image map(image.width, image.height, 1);
    parallel_for(map.pixel_count(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) map.floats()[i] = float(ciede2000(lab(a, i), lab(b, i)));
    });
    return map;
}

Result<double> mean_ciede2000(const Image& image, const Image& reference, const Image& mask) {
    DERMIS_TRY_ASSIGN(const Image map, ciede2000_map(image, reference));
    return mean_of(map, mask);
}

}  // namespace dermis::inline image
