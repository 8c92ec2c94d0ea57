#include "dermis/bake/shadow_ramp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/bake/rows.h"
#include "dermis/bake/shadow_table.h"
#include "dermis/base/parallel.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/shadow_edge.h"

namespace dermis::inline bake {
namespace {

// Share of a disk light past a straight edge, blurred by a Gaussian. The disk's lines of light at u radii
// have a length of sqrt(1 - u^2), for which the nodes are Chebyshev's of the second kind.
double blurred_disk_share(double x_mm, double radius_mm, double sigma_mm) {
    constexpr int kLines = 127;
    double light = 0;
    for (int i = 1; i <= kLines; ++i) {
        const double angle = i * std::numbers::pi / (kLines + 1), sine = std::sin(angle);
        const double away = (x_mm - radius_mm * std::cos(angle)) / sigma_mm;
        light += 2.0 / (kLines + 1) * sine * sine * normal_cdf(away);
    }
    return light;
}

Rgb scattered_edge(const GaussianSum& profile, double x_mm, double radius_mm) {
    Rgb light = {};
    const Rgb total = total_weight(profile.terms);
    for (const GaussianTerm& term : profile.terms) {
        const double lit = blurred_disk_share(x_mm, radius_mm, std::sqrt(term.variance_mm2));
        for (size_t c = 0; c < 3; ++c) light[c] += term.weight[c] * lit;
    }
    for (size_t c = 0; c < 3; ++c) light[c] /= total[c];
    return light;
}

}  // namespace

Result<std::vector<Rgb>> shadow_ramp(const Profile& profile, double width_mm, int count) {
    DERMIS_TRY(check_preintegrable(profile, {}));
    const GaussianSum gaussians = to_gaussian_sum(profile, kShadowGaussians).sum;
    const double filter_mm = 0.5 * width_mm, light_mm = 0.5 * std::min(kLightEdgeMm, width_mm);
    const Rgb dark = scattered_edge(gaussians, -filter_mm, light_mm),
              lit = scattered_edge(gaussians, filter_mm, light_mm);
    std::vector<Rgb> ramp(static_cast<size_t>(count));
    parallel_for(ramp.size(), 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const double x_mm = filter_mm * disk_offset(double(i) / (count - 1));
            ramp[i] = scattered_edge(gaussians, x_mm, light_mm);
            for (size_t c = 0; c < 3; ++c) ramp[i][c] = (ramp[i][c] - dark[c]) / (lit[c] - dark[c]);
        }
    });
    return ramp;
}

}  // namespace dermis::inline bake
