// Whole rows of a table. The even basis functions depend on N.L alone, so they are computed once; a row is
// then a small matrix product, arranged in blocks that stay in registers, plus tails near the terminator.

#include <algorithm>
#include <cmath>

#include "dermis/optics/preintegration/row.h"

namespace dermis::inline optics {
namespace pre = preintegration;
namespace {

constexpr size_t kLanes = 8;  // elevations in a block: three channels of accumulators fit 16 SSE registers

using Block = std::array<std::array<double, kLanes>, 3>;

// Contiguous: function by function for the lanes of one block.
Block accumulate(const pre::Row& row, const double* basis) {
    Block sum = {};
    for (size_t k = 0; k < row.coefficients; ++k, basis += kLanes)
        for (size_t c = 0; c < 3; ++c)
            for (size_t lane = 0; lane < kLanes; ++lane) sum[c][lane] += row.coefficient[k][c] * basis[lane];
    return sum;
}

}  // namespace

DiffuseRows::DiffuseRows(std::span<const double> n_dot_l, const Preintegration& how)
    : how_(how), n_dot_l_(n_dot_l.begin(), n_dot_l.end()), elevation_of_(n_dot_l.size()) {
    // Values that are opposite to rounding share their even part.
    constexpr double kSame = 1e-14;
    std::vector<size_t> order(size());
    for (size_t i = 0; i < size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](size_t i) { return std::abs(n_dot_l_[i]); });
    for (size_t i : order) {
        const double sine = std::abs(n_dot_l_[i]);
        if (sine_.empty() || sine > sine_.back() + kSame) sine_.push_back(sine);
        elevation_of_[i] = sine_.size() - 1;
    }
    for (double sine : sine_) chord_squared_.push_back(pre::chord_squared(sine));

    const size_t functions = pre::basis_size(how.construction);
    const size_t blocks = (sine_.size() + kLanes - 1) / kLanes;
    std::vector<double> values(functions);
    basis_.assign(blocks * functions * kLanes, 0);
    for (size_t j = 0; j < sine_.size(); ++j) {
        pre::evaluate_basis(how.construction, sine_[j], values);
        for (size_t k = 0; k < functions; ++k)
            basis_[(j / kLanes * functions + k) * kLanes + j % kLanes] = values[k];
    }
}

template <class Number>
void DiffuseRows::evaluate_into(const GaussianSum& profile, double radius_mm, std::span<Number> rgb) const {
    const pre::Row row(profile, radius_mm, how_);
    const size_t functions = pre::basis_size(how_.construction);
    std::vector<Rgb> even(sine_.size());
    for (size_t j = 0; j < even.size(); j += kLanes) {
        const Block block = accumulate(row, basis_.data() + j * functions);
        for (size_t lane = 0; lane < std::min(kLanes, even.size() - j); ++lane)
            even[j + lane] = {block[0][lane], block[1][lane], block[2][lane]};
    }
    for (const pre::NarrowLobe& lobe : row.narrow)
        for (size_t j = 0; j < even.size() && chord_squared_[j] <= lobe.tail.reach(); ++j) {
            const double tail = lobe.tail(sine_[j], chord_squared_[j]);
            for (size_t c = 0; c < 3; ++c) even[j][c] += lobe.weight[c] * tail;
        }
    for (size_t i = 0; i < size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            rgb[3 * i + c] = Number(even[elevation_of_[i]][c] + row.odd_part(n_dot_l_[i], c));
}

void DiffuseRows::evaluate(const GaussianSum& profile, double radius_mm, std::span<double> rgb) const {
    evaluate_into(profile, radius_mm, rgb);
}

void DiffuseRows::evaluate(const GaussianSum& profile, double radius_mm, std::span<float> rgb) const {
    evaluate_into(profile, radius_mm, rgb);
}

}  // namespace dermis::inline optics
