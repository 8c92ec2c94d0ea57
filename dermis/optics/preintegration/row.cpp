#include "dermis/optics/preintegration/row.h"

#include <cmath>
#include <limits>

namespace dermis::inline optics {
namespace preintegration {
namespace {

// Limits the concentration of very narrow lobes, since infinity has no series; the error is below rounding.
constexpr double kMaxConcentration = 1e34;

double concentration_of(const GaussianTerm& term, double radius_mm, const Preintegration& how) {
    return std::min(radius_mm / term.variance_mm2 * radius_mm / how.variance_scale, kMaxConcentration);
}

std::vector<Lobe> lobes_of(const GaussianSum& profile, double radius_mm, const Preintegration& how) {
    std::vector<Lobe> lobes;
    for (const GaussianTerm& term : profile.terms)
        lobes.push_back(lobe(how.construction, concentration_of(term, radius_mm, how)));
    return lobes;
}

// Mass of the lobe times the Gaussian's own normalisation. On the sphere the area of the Gaussian cancels the
// kappa of the lobe's area, so the mass alone remains.
double measure_of(const GaussianTerm& term, const Lobe& lobe, const Preintegration& how) {
    if (how.construction == Construction::sphere) return lobe.mass;
    const double width =
        how.ring_weights == RingWeights::line ? std::sqrt(term.variance_mm2) : term.variance_mm2;
    return lobe.mass / width;
}

std::vector<Rgb> weights_of(const GaussianSum& profile, const std::vector<Lobe>& lobes,
                            const Preintegration& how) {
    std::vector<Rgb> weights(lobes.size());
    Rgb total = {};
    for (size_t i = 0; i < lobes.size(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            weights[i][c] = profile.terms[i].weight[c] * measure_of(profile.terms[i], lobes[i], how);
            total[c] += weights[i][c];
        }
    for (Rgb& weight : weights)
        for (size_t c = 0; c < 3; ++c)
            weight[c] = total[c] > 0 ? weight[c] / total[c] : std::numeric_limits<double>::quiet_NaN();
    return weights;
}

}  // namespace

Row::Row(const GaussianSum& profile, double radius_mm, const Preintegration& how) {
    const std::vector<Lobe> lobes = lobes_of(profile, radius_mm, how);
    const std::vector<Rgb> weights = weights_of(profile, lobes, how);
    for (size_t i = 0; i < lobes.size(); ++i) {
        const double concentration = concentration_of(profile.terms[i], radius_mm, how);
        const bool wide = concentration < kSwitchConcentration;
        for (size_t c = 0; c < 3; ++c)
            (wide ? series_cosine : local_cosine)[c] += weights[i][c] * lobes[i].mean_cosine;
        if (!wide) {
            narrow.push_back({LocalTail(how.construction, concentration), weights[i]});
            continue;
        }
        const EvenSeries series = even_series(how.construction, concentration);
        coefficients = std::max(coefficients, series.count);
        for (size_t k = 0; k < series.count; ++k)
            for (size_t c = 0; c < 3; ++c) coefficient[k][c] += weights[i][c] * series.coefficient[k];
    }
}

Rgb Row::even_part(std::span<const double> basis) const {
    Rgb sum = {};
    for (size_t k = 0; k < coefficients; ++k)
        for (size_t c = 0; c < 3; ++c) sum[c] += coefficient[k][c] * basis[k];
    return sum;
}

Rgb Row::tails(double sine, double chord_squared) const {
    Rgb sum = {};
    for (const NarrowLobe& lobe : narrow) {
        const double tail = lobe.tail(sine, chord_squared);
        for (size_t c = 0; c < 3; ++c) sum[c] += lobe.weight[c] * tail;
    }
    return sum;
}

Rgb Row::operator()(Construction construction, double n_dot_l) const {
    std::array<double, kMaxOrder + 2> storage;
    const std::span basis = std::span(storage).first(basis_size(construction));
    const double sine = std::abs(n_dot_l);
    evaluate_basis(construction, sine, basis);
    Rgb sum = even_part(basis);
    const Rgb tail = tails(sine, chord_squared(sine));
    for (size_t c = 0; c < 3; ++c) sum[c] += tail[c] + odd_part(n_dot_l, c);
    return sum;
}

}  // namespace preintegration

std::vector<Rgb> lobe_weights(const GaussianSum& profile, double radius_mm, const Preintegration& how) {
    return preintegration::weights_of(profile, preintegration::lobes_of(profile, radius_mm, how), how);
}

}  // namespace dermis::inline optics
