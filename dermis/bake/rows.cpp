#include "dermis/bake/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace dermis::inline bake
