#include "techniques/preintegrated/normal_blend.h"

#include <algorithm>
#include <cmath>

namespace dermis {
namespace {

constexpr double kWidestShare = 0.5;

// Of two Gaussians along a line under a spectrum 1 / k^2, without the constant that all share.
double inner_product(double variance_sum_mm2) {
    return -std::sqrt(variance_sum_mm2);
}

// Along one axis; a sum of Gaussians has the weighted mean of theirs.
double largest_variance_mm2(const GaussianSum& profile) {
    double largest = 0;
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0, weight = 0;
        for (const GaussianTerm& term : profile.terms)
            sum += term.weight[c] * term.variance_mm2, weight += term.weight[c];
        if (weight > 0) largest = std::max(largest, sum / weight);
    }
    return largest;
}

double weight_of(const GaussianSum& profile, size_t channel, double s0, double s1) {
    double total = 0, kept = 0;  // kept: <T(s0), G(s0) - G(s1)>
    for (const GaussianTerm& term : profile.terms) {
        const double v = term.variance_mm2, w = term.weight[channel];
        kept += w * (inner_product(2 * s0 + v) - inner_product(s0 + s1 + v));
        total += w;
    }
    if (total <= 0) return 0;
    const double difference = inner_product(2 * s0) - inner_product(s0 + s1) - kept / total;
    const double norm = inner_product(2 * s0) - 2 * inner_product(s0 + s1) + inner_product(2 * s1);
    return std::clamp(difference / norm, 0.0, 1.0);
}

}  // namespace

double widest_blend_mm(const GaussianSum& profile) {
    return kWidestShare * std::sqrt(12 * largest_variance_mm2(profile));
}

NormalBlend normal_blend(const GaussianSum& profile, double sharp_mm, double max_lod_bias) {
    NormalBlend blend;
    blend.lod_bias = std::clamp(std::log2(widest_blend_mm(profile) / sharp_mm), 0.0, max_lod_bias);
    if (blend.lod_bias < 1e-3) return blend;
    const double smooth_mm = sharp_mm * std::exp2(blend.lod_bias);
    for (size_t c = 0; c < 3; ++c)
        blend.weight[c] = weight_of(profile, c, sharp_mm * sharp_mm / 12, smooth_mm * smooth_mm / 12);
    return blend;
}

}  // namespace dermis
