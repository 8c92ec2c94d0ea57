#pragma once
// Internal to preintegration: one profile at one radius, ready to be evaluated anywhere. Wide lobes share one
// series, each narrow lobe adds its own tail near the terminator.

#include <algorithm>
#include <array>
#include <vector>

#include "dermis/optics/preintegration/local.h"
#include "dermis/optics/preintegration/series.h"

namespace dermis::inline optics::preintegration {

struct NarrowLobe {
    LocalTail tail;
    Rgb weight;
};

/// D(t) = sum_k coefficient_k basis_k(|t|) + sum_narrow weight tail(|t|)
///        + series_cosine t / 2 + local_cosine max(0, t).
struct Row {
    Rgb series_cosine = {}, local_cosine = {};  ///< weighted mean cosines of the two kinds of lobe
    std::array<Rgb, kMaxOrder + 2> coefficient = {};
    size_t coefficients = 0;
    std::vector<NarrowLobe> narrow;

    Row(const GaussianSum& profile, double radius_mm, const Preintegration& how);

    [[nodiscard]] Rgb even_part(std::span<const double> basis) const;
    [[nodiscard]] Rgb tails(double sine, double chord_squared) const;
    [[nodiscard]] double odd_part(double n_dot_l, size_t channel) const {
        return 0.5 * series_cosine[channel] * n_dot_l + local_cosine[channel] * std::max(0.0, n_dot_l);
    }
    [[nodiscard]] Rgb operator()(Construction construction, double n_dot_l) const;
};

}  // namespace dermis::inline optics::preintegration
