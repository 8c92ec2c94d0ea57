#include "dermis/optics/shadow_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dermis::inline optics {

double normal_cdf(double z) {
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double disk_share(double t) {
    t = std::clamp(t, -1.0, 1.0);
    return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi;
}

double disk_offset(double share) {
    double low = -1, high = 1;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (disk_share(middle) < share ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace dermis::inline optics
