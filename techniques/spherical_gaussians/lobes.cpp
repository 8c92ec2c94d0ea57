#include "techniques/spherical_gaussians/lobes.h"

#include <algorithm>
#include <cmath>

namespace dermis::spherical_gaussians {
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

Lobe merged(const Lobe& a, const Lobe& b, Width width) {
    const double weight = a.weight + b.weight;
    const auto mean = [&](double of_a, double of_b) { return (a.weight * of_a + b.weight * of_b) / weight; };
    if (width == Width::variance) return {weight, mean(a.variance_mm2, b.variance_mm2)};
    const double deviation = mean(std::sqrt(a.variance_mm2), std::sqrt(b.variance_mm2));
    return {weight, deviation * deviation};
}

// How far the standard deviations of both are from their mean, squared.
double loss(const Lobe& a, const Lobe& b) {
    const double apart = std::sqrt(a.variance_mm2) - std::sqrt(b.variance_mm2);
    return a.weight * b.weight / (a.weight + b.weight) * apart * apart;
}

void merge_nearest(std::vector<Lobe>& lobes, Width width) {
    size_t best = 0;
    for (size_t i = 1; i + 1 < lobes.size(); ++i)
        if (loss(lobes[i], lobes[i + 1]) < loss(lobes[best], lobes[best + 1])) best = i;
    lobes[best] = merged(lobes[best], lobes[best + 1], width);
    lobes.erase(lobes.begin() + ptrdiff_t(best) + 1);
}

}  // namespace

std::vector<ChannelGaussians> lobes_of(const GaussianSum& profile, int count, Width width) {
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

}  // namespace dermis::spherical_gaussians
