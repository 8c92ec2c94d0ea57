#pragma once
// A measured or simulated profile: R at increasing radii, linear in between, constant below the first radius,
// zero beyond the last.

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"

namespace dermis::inline optics {

inline constexpr size_t kMaxProfileRows = 100'000;

/// Immutable once made; holds prefix sums so that its CDF costs one binary search.
class TabulatedProfile {
  public:
    /// At least two rows; radii finite, >= 0, strictly increasing, the last 1e-6 to 1e6; R finite and >= 0,
    /// not all zero in every channel. `place` begins the error ("skin.csv"). At most kMaxProfileRows rows.
    [[nodiscard]] static Result<TabulatedProfile> make(std::span<const double> r_mm,
                                                       std::span<const Rgb> r_per_mm2,
                                                       std::string_view place);

    [[nodiscard]] const std::vector<double>& r_mm() const { return r_mm_; }
    [[nodiscard]] const std::vector<Rgb>& reflectance_per_mm2() const { return values_; }

    [[nodiscard]] double reflectance_at(int channel, double r_mm) const;
    /// 2 pi times the integral of R(r) r^(1 + power) from 0 to r_mm, power 0 (light), 1 or 2 (its moments).
    [[nodiscard]] double moment_within(int channel, int power, double r_mm) const;

    [[nodiscard]] TabulatedProfile scaled(double factor) const;

  private:
    TabulatedProfile(std::vector<double> r_mm, std::vector<Rgb> values);
    [[nodiscard]] double segment_moment(size_t segment, int channel, int power, double r_mm) const;

    std::vector<double> r_mm_;
    std::vector<Rgb> values_;
    std::vector<std::array<Rgb, 3>> moments_;  // [row][power][channel], up to that row
};

}  // namespace dermis::inline optics
