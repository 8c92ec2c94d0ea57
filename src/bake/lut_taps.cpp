#include "dermis/bake/lut_taps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/bake/rows.h"
#include "dermis/base/parallel.h"

namespace dermis {
namespace {

constexpr double kPi = std::numbers::pi;

struct Tap {
    double angle_rad;
    Rgb weight;
};

Rgb gaussian_line_profile(const GaussianSum& sum, double distance_mm, double variance_scale) {
    Rgb value = {};
    for (const GaussianTerm& term : sum.terms) {
        const double v = term.variance_mm2 * variance_scale;
        const double gaussian = std::exp(-distance_mm * distance_mm / (2 * v)) / std::sqrt(2 * kPi * v);
        for (size_t c = 0; c < 3; ++c) value[c] += term.weight[c] * gaussian;
    }
    return value;
}

std::vector<Tap> unity_taps(const GaussianSum& sum, double radius_mm, double variance_scale) {
    constexpr double kStep_rad = 0.05;
    std::vector<Tap> taps;
    Rgb total = {};
    for (int i = 0; - kPi / 2 + i * kStep_rad <= kPi / 2; ++i) {
        const double a = -kPi / 2 + i * kStep_rad;
        const double chord_mm = 2 * radius_mm * std::abs(std::sin(a / 2));
        taps.push_back({a, gaussian_line_profile(sum, chord_mm, variance_scale)});
        for (size_t c = 0; c < 3; ++c) total[c] += taps.back().weight[c];
    }
    for (Tap& tap : taps)
        for (size_t c = 0; c < 3; ++c) tap.weight[c] /= total[c];
    return taps;
}

std::vector<Tap> faceworks_taps(const GaussianSum& sum, double radius_mm, double variance_scale) {
    constexpr int kTaps = 200;
    constexpr double kReach_mm = 10;
    const double reach_mm = std::min(kPi * radius_mm, kReach_mm), step_mm = 2 * reach_mm / kTaps;
    std::vector<Tap> taps;
    for (int i = 0; i < kTaps; ++i) {
        const double arc_mm = -reach_mm + (i + 0.5) * step_mm;
        Tap tap{arc_mm / radius_mm, gaussian_line_profile(sum, arc_mm, variance_scale)};
        for (double& weight : tap.weight) weight *= step_mm;
        taps.push_back(tap);
    }
    return taps;
}

}  // namespace

Result<std::vector<float>> integrate_by_taps(const Table& table, const Profile& profile,
                                             std::span<const double> n_dot_l) {
    const auto* sum = std::get_if<GaussianSum>(&profile.model);
    if (!sum)
        return Error{"profile '" + profile.name + "' is " + model_name(profile) + "; the taps of " +
                     std::string(name_of(table.convention.integration)) + " need a sum of Gaussians"};
    if (Result<void> valid = check_preintegrable(profile, table.convention.how); !valid) return valid.error();
    const bool unity = table.convention.integration == Integration::unity_taps;
    std::vector<float> data(3 * n_dot_l.size() * size_t(table.height));
    parallel_for(size_t(table.height), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            const double radius_mm = radius_of(table.convention.axes[1], table.v_value(double(y)));
            const double scale = table.convention.how.variance_scale;
            const std::vector<Tap> taps =
                unity ? unity_taps(*sum, radius_mm, scale) : faceworks_taps(*sum, radius_mm, scale);
            for (size_t x = 0; x < n_dot_l.size(); ++x) {
                Rgb light = {};
                for (const Tap& tap : taps) {
                    const double cosine = std::cos(std::acos(n_dot_l[x]) + tap.angle_rad);
                    for (size_t c = 0; c < 3; ++c) light[c] += std::max(0.0, cosine) * tap.weight[c];
                }
                for (size_t c = 0; c < 3; ++c) data[3 * (n_dot_l.size() * y + x) + c] = float(light[c]);
            }
        }
    });
    return data;
}

}  // namespace dermis
