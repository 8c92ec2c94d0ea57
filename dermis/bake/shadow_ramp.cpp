#include "dermis/bake/shadow_ramp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/bake/shadow_table.h"

namespace dermis {

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

Result<std::vector<Rgb>> shadow_ramp(const Profile& profile, double width_mm, int count) {
    constexpr int kFine = 1024;
    const Result<Table> table = bake_shadow({.profile = profile,
                                             .width = kFine,
                                             .height = 1,
                                             .min_width_mm = width_mm,
                                             .max_width_mm = width_mm * 1.0001,
                                             .sharpening = std::max(1.0, width_mm / kLightEdgeMm)});
    if (!table) return table.error();
    const Rgb dark = lookup(*table, 0, width_mm), lit = lookup(*table, 1, width_mm);
    std::vector<Rgb> ramp;
    for (int i = 0; i < count; ++i) {
        Rgb light = lookup(*table, 0.5 + 0.5 * disk_offset(double(i) / (count - 1)), width_mm);
        for (size_t c = 0; c < 3; ++c) light[c] = (light[c] - dark[c]) / (lit[c] - dark[c]);
        ramp.push_back(light);
    }
    return ramp;
}

}  // namespace dermis
