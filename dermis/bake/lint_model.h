#pragma once
// Internal to the linter: candidate curves and how well texels agree with them.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dermis/bake/lint.h"
#include "dermis/optics/profile.h"

namespace dermis::lint {

/// A sample of the picture, turned so that columns are N.L (in the picture's direction) and rows the other
/// axis.
struct Sample {
    std::vector<double> u, v;   ///< texel index + 1/2 over the count, ascending
    int u_count = 0;            ///< texels along u
    std::vector<float> stored;  ///< [row][column][channel]

    [[nodiscard]] std::span<const float> row(size_t y) const {
        return std::span(stored).subspan(3 * u.size() * y, 3 * u.size());
    }
};
[[nodiscard]] Sample sample_of(const Image& linear_float, bool transposed);

/// N.L of the sample's columns under a hypothesis.
[[nodiscard]] std::vector<double> n_dot_l_of(const Sample& sample, const LintHypothesis& hypothesis);

/// Radii of the sample's rows; the axis is clamped to what is no negative curvature.
[[nodiscard]] std::vector<double> radii_of(const Sample& sample, const TableAxis& axis);

/// The sample as light.
[[nodiscard]] std::vector<float> decoded(const Sample& sample, const LintHypothesis& hypothesis);

/// Curves of one model at radii of equal ratio, 0.25 mm to 2 m.
inline constexpr int kRadii = 128;
[[nodiscard]] double bank_radius_mm(double index);
[[nodiscard]] double bank_index(double radius_mm);

struct Bank {
    std::vector<float> curves;  ///< [radius][column][channel]
    size_t row_values = 0;
    [[nodiscard]] std::span<const float> curve(size_t radius) const {
        return std::span(curves).subspan(radius * row_values, row_values);
    }
};
/// `profile` is the hypothesis' own, as a sum of Gaussians.
[[nodiscard]] Bank make_bank(const LintHypothesis& hypothesis, const Profile& profile,
                             std::span<const double> n_dot_l);

/// Mean square over all rows with the radius of each row free; radii_mm receives them.
[[nodiscard]] double free_fit(const Bank& bank, std::span<const float> light, std::vector<double>& radii_mm);

/// Fits axis.min and axis.max of the hypothesis (curvature or radius, whichever is better) and fills rms.
void fit_axis(const Bank& bank, const Sample& sample, std::span<const float> light,
              const std::vector<double>& radii_mm, LintHypothesis& hypothesis);

/// What a table may have been made of: construction and profile of the hypothesis are set. Profiles that are
/// no sums of Gaussians are replaced by their fit, which is exact enough to distinguish them.
struct Model {
    LintHypothesis hypothesis;
    std::shared_ptr<const Profile> profile;
};
/// Every construction for every preset, and the published taps for GPU Gems 3.
[[nodiscard]] std::vector<Model> all_models();

/// Fills findings and advice from the numbers of the report.
void explain(LintReport& report, const Image& image);

}  // namespace dermis::lint
