#include "dermis/optics/artistic_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dermis::inline optics {
namespace {

// The Gaussians that spread a channel's light, along a line; the weights sum to 1.
struct LineTerm {
    double sigma_mm, weight;
};
std::vector<LineTerm> line_terms(double falloff) {
    const std::vector<GaussianTerm> skin = gpu_gems_3_skin().terms;
    std::vector<LineTerm> terms;
    double total = 0;
    for (size_t i = 1; i < skin.size(); ++i) {
        const double sigma_mm = std::sqrt(skin[i].variance_mm2), weight = skin[i].weight[kRed] / sigma_mm;
        terms.push_back({sigma_mm * (0.001 + falloff), weight});
        total += weight;
    }
    for (LineTerm& term : terms) term.weight /= total;
    return terms;
}

}  // namespace

GaussianSum line_kernel(const ArtisticKernel& kernel) {
    GaussianSum sum = {.name = "artistic", .terms = {{.variance_mm2 = 0}}};
    for (size_t c = 0; c < 3; ++c) {
        sum.terms[0].weight[c] = 1 - kernel.strength[c];
        for (const LineTerm& line : line_terms(kernel.falloff[c])) {
            GaussianTerm term = {.variance_mm2 = line.sigma_mm * line.sigma_mm, .weight = {}};
            term.weight[c] = kernel.strength[c] * line.weight;
            sum.terms.push_back(term);
        }
    }
    return sum;
}

Rgb mean_square_along_line_mm2(const ArtisticKernel& kernel, double reach_mm) {
    Rgb mean_square = {};
    for (size_t c = 0; c < 3; ++c) {
        double within = 0, moment = 0;
        for (const LineTerm& line : line_terms(kernel.falloff[c])) {
            const double sigmas = reach_mm / line.sigma_mm, share = std::erf(sigmas / std::numbers::sqrt2);
            const double cut = std::isinf(sigmas) ? 0
                                                  : sigmas * std::sqrt(2 / std::numbers::pi) *
                                                        std::exp(-sigmas * sigmas / 2);
            within += line.weight * share;
            moment += line.weight * line.sigma_mm * line.sigma_mm * (share - cut);
        }
        mean_square[c] = kernel.strength[c] * moment / within;
    }
    return mean_square;
}

KernelWidth fitted_width(const Rgb& kernel_mm2, const Profile& skin) {
    double both = 0, of_kernel = 0, of_skin = 0;
    for (size_t c = 0; c < 3; ++c) {
        const double albedo = diffuse_albedo(skin, int(c));
        const double skin_mm2 = albedo * mean_square_radius_mm2(skin, int(c)) / 2;
        both += albedo * kernel_mm2[c] * skin_mm2;
        of_kernel += albedo * kernel_mm2[c] * albedo * kernel_mm2[c];
        of_skin += skin_mm2 * skin_mm2;
    }
    // The least of the sum of (width^2 kernel - skin)^2.
    const double squared = both / of_kernel;
    return {std::sqrt(squared), 1 - std::sqrt(std::max(1 - squared * both / of_skin, 0.0))};
}

}  // namespace dermis::inline optics
