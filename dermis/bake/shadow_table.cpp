// S' = 6 k u (1 - u) on 0 <= u <= 1, u = 1/2 + k (p - 1/2). In units of the sharpened ramp the blurred step
// is int_0^1 6 u (1 - u) Phi((x - u) / s) du; by parts, with moments of the normal distribution over [0, 1],
// it is Phi at the lit end plus polynomials times Phi and phi. For s beyond the ramp those cancel; there the
// integral itself is smooth and 24 Gauss nodes give it to rounding.

#include "dermis/bake/shadow_table.h"

#include <cmath>
#include <numbers>

#include "dermis/bake/rows.h"
#include "dermis/base/parallel.h"
#include "dermis/base/text.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/preintegration/quadrature.h"
#include "dermis/optics/shadow_edge.h"

namespace dermis::inline bake {
namespace {

double normal_density(double x) {
    return std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
}

// int_0^1 S(u) n((x - u)/s)/s du + P(u > 1), moments m_k = int_0^1 u^k n du by recursion.
double by_moments(double x, double s) {
    const double low = normal_density(-x / s), high = normal_density((1 - x) / s);
    const double m0 = normal_cdf((1 - x) / s) - normal_cdf(-x / s);
    const double m1 = x * m0 + s * (low - high);
    const double m2 = x * m1 + s * s * m0 - s * high;
    const double m3 = x * m2 + 2 * s * s * m1 - s * high;
    return 3 * m2 - 2 * m3 + normal_cdf((x - 1) / s);
}

double by_quadrature(double x, double s) {
    static const preintegration::GaussLegendre<24> rule;
    double sum = 0;
    for (size_t i = 0; i < rule.size(); ++i) {
        const double u = rule.node(i);
        sum += rule.weight(i) * 6 * u * (1 - u) * normal_cdf((x - u) / s);
    }
    return sum;
}

Result<void> check(const ShadowOptions& options) {
    if (Result<void> size = check_table_size(options.width, options.height); !size) return size;
    if (!(options.sharpening >= 1 && options.sharpening <= 1000))
        return Error{"sharpening is " + to_text(options.sharpening) + ", must be 1 to 1000"};
    return check_preintegrable(options.profile, {});
}

}  // namespace

double blurred_smoothstep(double position, double sigma, double sharpening) {
    const double x = 0.5 + sharpening * (position - 0.5), s = sharpening * sigma;
    return s < 0.5 ? by_moments(x, s) : by_quadrature(x, s);
}

Result<Table> bake_shadow(const ShadowOptions& options) {
    DERMIS_TRY(check(options));
    Table table{.width = options.width, .height = options.height};
    table.convention = {.kind = TableKind::shadow,
                        .axes = {TableAxis{"penumbra_position", "1", 0, 1},
                                 TableAxis{"penumbra_width_mm", "mm", options.min_width_mm,
                                           options.max_width_mm, options.width_warp}},
                        .shadow_sharpening = options.sharpening,
                        .profile = options.profile.name,
                        .tool = tool_version()};
    DERMIS_TRY(check_axis(table.convention.axes[1], 0.01, 10000));
    const GaussianSum sum = to_gaussian_sum(options.profile, kShadowGaussians).sum;
    const Rgb total = total_weight(sum.terms);

    table.data.resize(size_t(table.width) * size_t(table.height) * 3);
    parallel_for(size_t(table.height), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < table.width; ++x) {
                Rgb light = {};
                for (const GaussianTerm& term : sum.terms) {
                    const double sigma = std::sqrt(term.variance_mm2) / table.v_value(double(y));
                    const double lit = blurred_smoothstep(table.u_value(x), sigma, options.sharpening);
                    for (size_t c = 0; c < 3; ++c) light[c] += term.weight[c] / total[c] * lit;
                }
                for (size_t c = 0; c < 3; ++c)
                    table.data[3 * (y * size_t(table.width) + size_t(x)) + c] = float(light[c]);
            }
    });
    return table;
}

}  // namespace dermis::inline bake
