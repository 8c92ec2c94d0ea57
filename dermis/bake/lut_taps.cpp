#include "dermis/bake/lut_taps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/bake/rows.h"
#include "dermis/base/parallel.h"

namespace dermis::inline bake {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMaxRadius_mm = 1e6;  // infinity times an angle of 0 has no value

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

// The published programs have one profile, whose weights sum to 1 in each channel; others' sum to the albedo,
// which a table does not contain.
GaussianSum without_albedo(GaussianSum sum) {
    const Rgb total = total_weight(sum.terms);
    for (GaussianTerm& term : sum.terms)
        for (size_t c = 0; c < 3; ++c)
            if (total[c] > 0) term.weight[c] /= total[c];
    return sum;
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
    // On a nearly flat ring every tap is beyond the profile's reach; the limit is the nearest tap alone.
    const auto nearest =
        std::ranges::min_element(taps, {}, [](const Tap& tap) { return std::abs(tap.angle_rad); });
    for (size_t c = 0; c < 3; ++c) {
        if (!(total[c] > 0)) nearest->weight[c] = total[c] = 1;
        for (Tap& tap : taps) tap.weight[c] /= total[c];
    }
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

Rgb lit_by(const std::vector<Tap>& taps, double theta_rad) {
    Rgb light = {};
    for (const Tap& tap : taps) {
        const double cosine = std::max(0.0, std::cos(theta_rad + tap.angle_rad));
        for (size_t c = 0; c < 3; ++c) light[c] += cosine * tap.weight[c];
    }
    return light;
}

}  // namespace

Result<std::vector<float>> integrate_by_taps(const Profile& profile, Integration integration,
                                             std::span<const double> n_dot_l,
                                             std::span<const double> radii_mm, const Preintegration& how) {
    const auto* sum = std::get_if<GaussianSum>(&profile.model);
    if (!sum)
        return Error{"profile '" + profile.name + "' is " + model_name(profile) + "; " +
                     std::string(name_of(integration)) + " need a sum of Gaussians"};
    DERMIS_TRY(check_preintegrable(profile, how));
    const GaussianSum white = without_albedo(*sum);
    std::vector<double> theta;
    for (double t : n_dot_l) theta.push_back(std::acos(t));
    std::vector<float> data(3 * n_dot_l.size() * radii_mm.size());
    parallel_for(radii_mm.size(), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            const double radius_mm = std::min(radii_mm[y], kMaxRadius_mm);
            const std::vector<Tap> taps = integration == Integration::unity_taps
                                              ? unity_taps(white, radius_mm, how.variance_scale)
                                              : faceworks_taps(white, radius_mm, how.variance_scale);
            float* out = data.data() + 3 * n_dot_l.size() * y;
            for (double angle_rad : theta) {
                const Rgb light = lit_by(taps, angle_rad);
                for (size_t c = 0; c < 3; ++c) *out++ = float(light[c]);
            }
        }
    });
    return data;
}

Result<std::vector<float>> integrate_model(const Profile& profile, Integration integration,
                                           std::span<const double> n_dot_l, std::span<const double> radii_mm,
                                           const Preintegration& how) {
    if (integration == Integration::exact) return integrate_rows(profile, n_dot_l, radii_mm, how);
    return integrate_by_taps(profile, integration, n_dot_l, radii_mm, how);
}

}  // namespace dermis::inline bake
