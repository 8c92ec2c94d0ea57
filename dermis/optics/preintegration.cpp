#include "dermis/optics/preintegration.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/optics/preintegration/quadrature.h"
#include "dermis/optics/preintegration/row.h"

namespace dermis::inline optics {
namespace pre = preintegration;
namespace {

using std::numbers::pi;

// The even part of D against cos(b) db, times 1 and times P_2(sin b), over half the range. The series has at
// most the order that 40 Gauss nodes integrate exactly; a tail is a smooth function of the chord, over its
// reach.
std::array<Rgb, 2> even_moments(const pre::Row& row, Construction construction) {
    std::array<Rgb, 2> moments = {};
    const auto add = [&](const Rgb& value, double sine, double measure) {
        for (size_t c = 0; c < 3; ++c) {
            moments[0][c] += measure * value[c];
            moments[1][c] += measure * value[c] * (1.5 * sine * sine - 0.5);
        }
    };
    std::array<double, pre::kMaxOrder + 2> storage;
    const std::span basis = std::span(storage).first(pre::basis_size(construction));
    static const pre::GaussLegendre<48> rule;
    for (size_t i = 0; i < rule.size(); ++i) {
        const double b = rule.node(i) * pi / 2;
        pre::evaluate_basis(construction, std::sin(b), basis);
        add(row.even_part(basis), std::sin(b), rule.weight(i) * pi / 2 * std::cos(b));
    }
    for (const pre::NarrowLobe& lobe : row.narrow) {
        const double reach = std::sqrt(lobe.tail.reach());
        for (size_t i = 0; i < rule.size(); ++i) {
            const double chord = rule.node(i) * reach, x = chord * chord;
            const double sine = chord * std::sqrt(1 - x / 4);
            const double tail = lobe.tail(sine, x);
            add({tail * lobe.weight[0], tail * lobe.weight[1], tail * lobe.weight[2]}, sine,
                rule.weight(i) * reach * (1 - x / 2) / std::sqrt(1 - x / 4));
        }
    }
    // max(0, t) of the narrow lobes: its even half is t / 2.
    for (size_t c = 0; c < 3; ++c) {
        moments[0][c] += row.local_cosine[c] / 4;
        moments[1][c] += row.local_cosine[c] / 16;
    }
    return moments;
}

}  // namespace

double blurred_cosine(Construction construction, double n_dot_l, double concentration) {
    const GaussianSum single = {"", {{1, {1, 1, 1}}}};
    constexpr double kLeast = 1e-60;  // negligible, and its weight can still be normalised
    return preintegrated_diffuse(single, n_dot_l, std::sqrt(std::max(concentration, kLeast)),
                                 {.construction = construction})[0];
}

Result<void> check_preintegrable(const GaussianSum& profile) {
    const std::string name = "profile '" + profile.name + "'";
    if (profile.terms.empty()) return Error{name + " has no Gaussians; it needs at least 1"};
    Rgb total = {};
    for (size_t i = 0; i < profile.terms.size(); ++i) {
        const GaussianTerm& term = profile.terms[i];
        const std::string place = name + ", Gaussian " + std::to_string(i + 1);
        if (!(term.variance_mm2 > 0) || !std::isfinite(term.variance_mm2))
            return Error{place + ": variance_mm2 is " + to_text(term.variance_mm2) +
                         ", must be positive and finite"};
        for (size_t c = 0; c < 3; ++c) {
            if (!std::isfinite(term.weight[c]))
                return Error{place + ": weight is " + to_text(term.weight[c]) + ", must be finite"};
            total[c] += term.weight[c];
        }
    }
    for (size_t c = 0; c < 3; ++c)
        if (!(total[c] > 0))
            return Error{name + ": the weights of channel " + std::string(1, "rgb"[c]) + " sum to " +
                         to_text(total[c]) + ", must be above 0"};
    return {};
}

Rgb preintegrated_diffuse(const GaussianSum& profile, double n_dot_l, double radius_mm,
                          const Preintegration& how) {
    return pre::Row(profile, radius_mm, how)(how.construction, n_dot_l);
}

Rgb preintegrated_mean_cosine(const GaussianSum& profile, double radius_mm, const Preintegration& how) {
    const pre::Row row(profile, radius_mm, how);
    Rgb sum = row.series_cosine;
    for (size_t c = 0; c < 3; ++c) sum[c] += row.local_cosine[c];
    return sum;
}

std::array<Rgb, 3> preintegrated_zonal_harmonics(const GaussianSum& profile, double radius_mm,
                                                 const Preintegration& how) {
    const pre::Row row(profile, radius_mm, how);
    const std::array<Rgb, 2> moments = even_moments(row, how.construction);
    std::array<Rgb, 3> zonal;
    for (size_t c = 0; c < 3; ++c) {
        zonal[0][c] = 2 * std::sqrt(pi) * moments[0][c];
        zonal[1][c] = std::sqrt(pi / 3) * (row.series_cosine[c] + row.local_cosine[c]);
        zonal[2][c] = 2 * std::sqrt(5 * pi) * moments[1][c];
    }
    return zonal;
}

}  // namespace dermis::inline optics
