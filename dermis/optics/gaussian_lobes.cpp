#include "dermis/optics/gaussian_lobes.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace dermis::inline optics {
namespace {

constexpr double kLeastVarianceMm2 = 1e-6;

struct Lobe {
    double weight, variance_mm2;
};

// Narrow to wide.
std::vector<Lobe> lobes_of_channel(const std::vector<ChannelGaussians>& gaussians, size_t channel) {
    double total = 0;
    for (const ChannelGaussians& g : gaussians) total += g.weight[channel];
    if (!(total > 0)) return {{1, kLeastVarianceMm2}};
    std::vector<Lobe> lobes;
    for (const ChannelGaussians& g : gaussians)
        if (g.weight[channel] > 0)
            lobes.push_back(
                {g.weight[channel] / total, std::max(g.variance_mm2[channel], kLeastVarianceMm2)});
    return lobes;
}

Lobe merged(const Lobe& a, const Lobe& b, LobeWidth width) {
    const double weight = a.weight + b.weight;
    const auto mean = [&](double of_a, double of_b) { return (a.weight * of_a + b.weight * of_b) / weight; };
    if (width == LobeWidth::variance) return {weight, mean(a.variance_mm2, b.variance_mm2)};
    const double deviation = mean(std::sqrt(a.variance_mm2), std::sqrt(b.variance_mm2));
    return {weight, deviation * deviation};
}

// How far the standard deviations of both are from their mean, squared.
double loss(const Lobe& a, const Lobe& b) {
    const double apart = std::sqrt(a.variance_mm2) - std::sqrt(b.variance_mm2);
    return a.weight * b.weight / (a.weight + b.weight) * apart * apart;
}

void merge_nearest(std::vector<Lobe>& lobes, LobeWidth width) {
    size_t best = 0;
    for (size_t i = 1; i + 1 < lobes.size(); ++i)
        if (loss(lobes[i], lobes[i + 1]) < loss(lobes[best], lobes[best + 1])) best = i;
    lobes[best] = merged(lobes[best], lobes[best + 1], width);
    lobes.erase(lobes.begin() + ptrdiff_t(best) + 1);
}

}  // namespace

std::vector<ChannelGaussians> lobes_of(const GaussianSum& profile, int count, LobeWidth width) {
    const std::vector<ChannelGaussians> gaussians = by_channel(profile);
    std::vector<ChannelGaussians> all;
    for (size_t c = 0; c < 3; ++c) {
        std::vector<Lobe> lobes = lobes_of_channel(gaussians, c);
        while (lobes.size() > size_t(count)) merge_nearest(lobes, width);
        if (all.size() < lobes.size()) all.resize(lobes.size());
        for (size_t i = 0; i < lobes.size(); ++i) {
            all[i].weight[c] = lobes[i].weight;
            all[i].variance_mm2[c] = lobes[i].variance_mm2;
        }
    }
    return all;
}

double merging_error(const GaussianSum& profile, const std::vector<ChannelGaussians>& lobes,
                     double least_radius_mm) {
    GaussianSum few;
    for (const ChannelGaussians& lobe : lobes)
        for (size_t c = 0; c < 3; ++c) {
            GaussianTerm term{.variance_mm2 = lobe.variance_mm2[c], .weight = {0, 0, 0}};
            term.weight[c] = lobe.weight[c];
            few.terms.push_back(term);
        }
    constexpr int kCosines = 33, kRadii = 9;
    std::vector<double> n_dot_l;
    for (int i = 0; i < kCosines; ++i) n_dot_l.push_back(2.0 * i / (kCosines - 1) - 1);
    const DiffuseRows rows(n_dot_l);
    std::vector<double> exact(3 * n_dot_l.size()), merged(exact.size());
    double worst = 0;
    for (int i = 0; i < kRadii; ++i) {
        const double radius_mm = least_radius_mm * std::pow(2, 0.5 * i);
        rows.evaluate(profile, radius_mm, std::span(exact));
        rows.evaluate(few, radius_mm, std::span(merged));
        for (size_t k = 0; k < exact.size(); ++k) worst = std::max(worst, std::abs(exact[k] - merged[k]));
    }
    return worst;
}

std::vector<ChannelGaussians> by_channel(const GaussianSum& sum) {
    std::vector<GaussianTerm> terms = sum.terms;
    std::ranges::stable_sort(terms, {}, &GaussianTerm::variance_mm2);
    std::vector<ChannelGaussians> all;
    std::array<size_t, 3> count = {0, 0, 0};
    for (const GaussianTerm& term : terms)
        for (size_t c = 0; c < 3; ++c) {
            if (term.weight[c] == 0) continue;
            if (count[c] == all.size()) all.emplace_back();
            all[count[c]].weight[c] = term.weight[c];
            all[count[c]++].variance_mm2[c] = term.variance_mm2;
        }
    return all;
}

}  // namespace dermis::inline optics
