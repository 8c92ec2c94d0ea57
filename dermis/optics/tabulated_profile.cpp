#include "dermis/optics/tabulated_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/optics/check_value.h"

namespace dermis::inline optics {
namespace {

// 2 pi times the integral of R(r) r^(1 + power) over [from, to], R linear between its values at both ends.
// With r = from + t h each power of t is summed by itself: no term is negative, so nothing cancels in a
// segment that is short against its radius.
double linear_moment(double at_from, double at_to, int power, double from, double to) {
    const double h = to - from;
    const int n = 1 + power;
    double sum = 0, binomial = 1;
    for (int k = 0; k <= n; ++k) {
        sum += binomial * std::pow(from, n - k) * std::pow(h, k) * (at_from / (k + 1) + at_to) / (k + 2);
        binomial = binomial * (n - k) / (k + 1);
    }
    return 2 * std::numbers::pi * h * sum;
}

}  // namespace

Result<TabulatedProfile> TabulatedProfile::make(std::span<const double> r_mm, std::span<const Rgb> r_per_mm2,
                                                std::string_view place) {
    const auto wrong = [&](const Error& error) { return Error{std::string(place) + ": " + error.message}; };
    if (r_mm.size() != r_per_mm2.size() || r_mm.size() < 2 || r_mm.size() > kMaxProfileRows)
        return wrong(out_of_range("the number of rows", double(r_mm.size()), "2 to 100000"));
    double largest = 0;
    for (size_t i = 0; i < r_mm.size(); ++i) {
        const std::string row = " of row " + std::to_string(i + 1);
        const std::string above = i == 0 ? ">= 0" : "above the row before, " + to_text(r_mm[i - 1]);
        if (!std::isfinite(r_mm[i]) || r_mm[i] < 0 || (i > 0 && r_mm[i] <= r_mm[i - 1]))
            return wrong(out_of_range("r_mm" + row, r_mm[i], above));
        if (r_mm[i] > 1e6) return wrong(out_of_range("r_mm" + row, r_mm[i], "at most 1e6"));
        for (int c = 0; c < 3; ++c) {
            const double value = r_per_mm2[i][size_t(c)];
            if (!(value >= 0 && value <= 1e12))
                return wrong(
                    out_of_range("the " + channel_name(c) + " reflectance" + row, value, "0 to 1e12"));
            if (r_mm[i] > 0 || i == 0) largest = std::max(largest, value);
        }
    }
    if (r_mm.back() < 1e-6) return wrong(out_of_range("the last r_mm", r_mm.back(), "at least 1e-6"));
    if (largest == 0) return wrong({"the table has no reflectance at all; one value must be > 0"});
    TabulatedProfile profile({r_mm.begin(), r_mm.end()}, {r_per_mm2.begin(), r_per_mm2.end()});
    for (int c = 0; c < 3; ++c) {
        const double albedo = profile.moment_within(c, 0, profile.r_mm_.back());
        if (!std::isfinite(albedo) || albedo > 1e9)
            return wrong(out_of_range("the albedo of " + channel_name(c), albedo, "finite"));
    }
    return profile;
}

TabulatedProfile::TabulatedProfile(std::vector<double> r_mm, std::vector<Rgb> values)
    : r_mm_(std::move(r_mm)), values_(std::move(values)), moments_(r_mm_.size()) {
    for (int power = 0; power < 3; ++power)
        for (int c = 0; c < 3; ++c) {
            const size_t p = size_t(power), channel = size_t(c);
            moments_[0][p][channel] =
                linear_moment(values_[0][channel], values_[0][channel], power, 0, r_mm_[0]);
            for (size_t i = 1; i < r_mm_.size(); ++i)
                moments_[i][p][channel] =
                    moments_[i - 1][p][channel] + segment_moment(i - 1, c, power, r_mm_[i]);
        }
}

// From the segment's first radius to r_mm, which lies in it.
double TabulatedProfile::segment_moment(size_t segment, int channel, int power, double r_mm) const {
    const size_t c = size_t(channel);
    const double r0 = r_mm_[segment], r1 = r_mm_[segment + 1];
    const double v0 = values_[segment][c], v1 = values_[segment + 1][c];
    return linear_moment(v0, std::lerp(v0, v1, (r_mm - r0) / (r1 - r0)), power, r0, r_mm);
}

double TabulatedProfile::reflectance_at(int channel, double r_mm) const {
    const size_t c = size_t(channel);
    if (r_mm <= r_mm_.front()) return values_.front()[c];
    if (r_mm > r_mm_.back()) return 0;
    const size_t next = size_t(std::lower_bound(r_mm_.begin(), r_mm_.end(), r_mm) - r_mm_.begin());
    const double t = (r_mm - r_mm_[next - 1]) / (r_mm_[next] - r_mm_[next - 1]);
    return std::lerp(values_[next - 1][c], values_[next][c], t);
}

double TabulatedProfile::moment_within(int channel, int power, double r_mm) const {
    const size_t c = size_t(channel), p = size_t(power);
    const double first = values_.front()[c];
    if (r_mm <= r_mm_.front()) return linear_moment(first, first, power, 0, std::max(0.0, r_mm));
    if (r_mm >= r_mm_.back()) return moments_.back()[p][c];
    const size_t next = size_t(std::lower_bound(r_mm_.begin(), r_mm_.end(), r_mm) - r_mm_.begin());
    return moments_[next - 1][p][c] + segment_moment(next - 1, channel, power, r_mm);
}

TabulatedProfile TabulatedProfile::scaled(double factor) const {
    std::vector<double> r_mm = r_mm_;
    std::vector<Rgb> values = values_;
    for (double& r : r_mm) r *= factor;
    for (auto& row : values)
        for (double& value : row) value /= factor * factor;
    return {std::move(r_mm), std::move(values)};
}

}  // namespace dermis::inline optics
