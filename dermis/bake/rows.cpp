#include "dermis/bake/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"

namespace dermis::inline bake {
namespace {

// Raise with every change to the quadrature: old cache entries are then not found.
constexpr std::string_view kCacheKind = "radial_rows_2";

// D is a function of |N.L| and an odd part, so mirrored columns are integrated once.
std::vector<double> distinct_magnitudes(std::span<const double> n_dot_l) {
    std::vector<double> all;
    for (double t : n_dot_l) all.push_back(std::abs(t));
    std::ranges::sort(all);
    const auto same = [](double a, double b) { return b - a < 1e-12; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    return all;
}

std::vector<float> radial_rows(const RadialProfile& profile, std::span<const double> n_dot_l,
                               std::span<const double> radii_mm) {
    std::vector<double> points = distinct_magnitudes(n_dot_l);
    const size_t magnitudes = points.size();
    std::vector<size_t> index;
    for (double t : n_dot_l)
        index.push_back(std::min<size_t>(
            size_t(std::ranges::lower_bound(points, std::abs(t) - 1e-12) - points.begin()), magnitudes - 1));
    points.push_back(-1);  // D(1) - D(-1) is the mean cosine
    points.push_back(1);

    std::vector<float> data(3 * n_dot_l.size() * radii_mm.size());
    Progress progress("integrating the profile", radii_mm.size());
    parallel_for(radii_mm.size(), 1, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row, progress.advance()) {
            const std::vector<Rgb> values = preintegrated_diffuse(profile, points, radii_mm[row]);
            float* out = data.data() + 3 * n_dot_l.size() * row;
            for (size_t i = 0; i < n_dot_l.size(); ++i)
                for (size_t c = 0; c < 3; ++c) {
                    const double mean_cosine = values.back()[c] - values[magnitudes][c];
                    // D(-|t|) = D(|t|) - A |t|
                    const double dark = n_dot_l[i] < 0 ? mean_cosine * n_dot_l[i] : 0;
                    *out++ = float(values[index[i]][c] + dark);
                }
        }
    });
    return data;
}

Result<std::vector<float>> cached_radial_rows(const Profile& profile, std::span<const double> n_dot_l,
                                              std::span<const double> radii_mm) {
    const auto make = [&] { return Result(radial_rows(radial_profile(profile), n_dot_l, radii_mm)); };
    const std::string hash =
        Hasher().add(hash_of(profile)).add(std::as_bytes(n_dot_l)).add(std::as_bytes(radii_mm)).hex();
    return cached(kCacheKind, hash, std::vector<float>(3 * n_dot_l.size() * radii_mm.size()), make);
}

}  // namespace

double radius_of(const TableAxis& axis, double value) {
    if (axis.name == "radius_mm") return value;
    return value > 0 ? 1 / value : std::numeric_limits<double>::infinity();
}

Result<void> check_curvature_axis(const TableAxis& axis) {
    if (axis.name == "curvature_per_mm") return check_axis(axis, 0, 1000);
    if (axis.name == "radius_mm") return check_axis(axis, 0.001, 1e6);
    return Error{unknown_name("axis", axis.name, std::vector<std::string>{"curvature_per_mm", "radius_mm"})};
}

RadialProfile radial_profile(const Profile& profile) {
    double finest_mm = std::numeric_limits<double>::infinity();
    for (int c = 0; c < 3; ++c) finest_mm = std::min(finest_mm, 0.25 * inverse_cdf_mm(profile, c, 0.25));
    return {.reflectance =
                [&profile](double distance_mm) {
                    Rgb value;
                    for (int c = 0; c < 3; ++c)
                        value[size_t(c)] = reflectance_per_mm2(profile, c, distance_mm);
                    return value;
                },
            .finest_mm = finest_mm};
}

Result<void> check_preintegrable(const Profile& profile, const Preintegration& how) {
    if (Result<void> valid = check(profile); !valid) return valid;
    if (!(how.variance_scale > 0) || !std::isfinite(how.variance_scale))
        return Error{"variance_scale is " + to_text(how.variance_scale) + ", must be positive and finite"};
    if (const auto* sum = std::get_if<GaussianSum>(&profile.model)) return check_preintegrable(*sum);
    if (how.construction != Construction::sphere || how.variance_scale != 1)
        return Error{
            "profile '" + profile.name + "' is " + model_name(profile) +
            "; a ring or a variance scale needs a sum of Gaussians (its ring integral need not exist)"};
    for (int c = 0; c < 3; ++c)
        if (!(diffuse_albedo(profile, c) > 0))
            return Error{"profile '" + profile.name + "': channel " + std::string(1, "rgb"[c]) +
                         " reflects nothing, which cannot be normalised"};
    return {};
}

Result<std::vector<float>> integrate_rows(const Profile& profile, std::span<const double> n_dot_l,
                                          std::span<const double> radii_mm, const Preintegration& how) {
    DERMIS_TRY(check_preintegrable(profile, how));
    const auto* sum = std::get_if<GaussianSum>(&profile.model);
    if (!sum) return cached_radial_rows(profile, n_dot_l, radii_mm);
    std::vector<float> data(3 * n_dot_l.size() * radii_mm.size());
    const DiffuseRows rows(n_dot_l, how);
    parallel_for(radii_mm.size(), 16, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row)
            rows.evaluate(*sum, radii_mm[row],
                          std::span(data).subspan(3 * rows.size() * row, 3 * rows.size()));
    });
    if (!std::ranges::all_of(data, [](float value) { return std::isfinite(value); }))
        return Error{"profile '" + profile.name +
                     "': its negative weights outweigh the others on the smallest radius of the axis"};
    return data;
}

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
