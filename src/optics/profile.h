#pragma once
// Diffusion profiles in the one form that every table, blur and reference uses: a sum of Gaussians per
// channel.
//
// R(r) = sum_i weight_i * exp(-r^2 / (2 variance_i)) / (2 pi variance_i), r in mm, R in 1/mm^2. The weights
// of a channel sum to its diffuse albedo, or to 1 when the profile is a pure blur kernel (then colour lies in
// the albedo map). Source: d'Eon, Luebke 2007, GPU Gems 3, chapter 14.

#include <array>
#include <string>
#include <vector>

namespace dermis {

/// One Gaussian; weights are linear red, green, blue and may be zero or (in fits only) negative.
struct GaussianTerm {
    double variance_mm2 = 1;
    std::array<double, 3> weight = {1, 1, 1};
};

struct GaussianSum {
    std::string name;
    std::vector<GaussianTerm> terms;
};

/// GPU Gems 3, table 14.1: six Gaussians fitted to a three-layer skin; weights of each channel sum to 1.
[[nodiscard]] GaussianSum gpu_gems_3_skin();

}  // namespace dermis
