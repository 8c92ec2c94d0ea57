// Each model is a set of overloads of the same few functions; the Profile's functions visit them. Every CDF
// has a closed form, and the transmittance and the general inverse follow from it.

#include "dermis/optics/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "dermis/base/hash.h"
#include "dermis/optics/check_value.h"
#include "dermis/optics/fresnel.h"

namespace dermis::inline optics {
namespace {

using std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double square(double x) {
    return x * x;
}

// ---- Sums of Gaussians -----------------------------------------------------------------------------------

template <class OfVariance>
double weighted(const GaussianSum& sum, int channel, OfVariance of_variance) {
    double total = 0;
    for (const GaussianTerm& term : sum.terms)
        total += term.weight[size_t(channel)] * of_variance(term.variance_mm2);
    return total;
}

Result<void> check_model(const GaussianSum& sum) {
    if (sum.terms.empty()) return Error{"the sum of Gaussians is empty; it needs at least one term"};
    double largest = 0;
    for (size_t i = 0; i < sum.terms.size(); ++i) {
        const std::string term = " of term " + std::to_string(i + 1);
        const double variance = sum.terms[i].variance_mm2;
        if (!(variance >= 1e-12 && variance <= 1e12))
            return out_of_range("variance_mm2" + term, variance, "1e-12 to 1e12");
        for (int c = 0; c < 3; ++c) {
            const double weight = sum.terms[i].weight[size_t(c)];
            if (!(weight >= 0 && weight <= 1e6))
                return out_of_range("the " + channel_name(c) + " weight" + term, weight, "0 to 1e6");
            largest = std::max(largest, weight);
        }
    }
    if (largest == 0) return Error{"all weights are 0; one must be > 0"};
    return {};
}

double albedo_of(const GaussianSum& sum, int channel) {
    return total_weight(sum.terms)[size_t(channel)];
}
double reflectance_of(const GaussianSum& sum, int channel, double r_mm) {
    return weighted(sum, channel, [&](double v) { return std::exp(-square(r_mm) / (2 * v)) / (2 * pi * v); });
}
double light_within(const GaussianSum& sum, int channel, double r_mm) {
    return weighted(sum, channel, [&](double v) { return -std::expm1(-square(r_mm) / (2 * v)); });
}
double mean_radius_times_albedo(const GaussianSum& sum, int channel) {
    return weighted(sum, channel, [](double v) { return std::sqrt(pi * v / 2); });
}
double mean_square_times_albedo(const GaussianSum& sum, int channel) {
    return weighted(sum, channel, [](double v) { return 2 * v; });
}

// ---- Burley ----------------------------------------------------------------------------------------------

Result<void> check_model(const BurleyProfile& burley) {
    for (int c = 0; c < 3; ++c) {
        const double albedo = burley.albedo[size_t(c)], d = burley.d_mm[size_t(c)];
        if (!(albedo >= 0 && albedo <= 1))
            return out_of_range("the albedo of " + channel_name(c), albedo, "0 to 1");
        if (!(d >= 1e-6 && d <= 1e6)) return out_of_range("d_mm of " + channel_name(c), d, "1e-6 to 1e6");
    }
    if (!(std::abs(burley.g) <= 0.99)) return out_of_range("g", burley.g, "-0.99 to 0.99");
    if (*std::ranges::max_element(burley.albedo) == 0) return Error{"all albedos are 0; one must be > 0"};
    return {};
}

double albedo_of(const BurleyProfile& burley, int channel) {
    return burley.albedo[size_t(channel)];
}
double reflectance_of(const BurleyProfile& burley, int channel, double r_mm) {
    const double d = burley.d_mm[size_t(channel)], albedo = burley.albedo[size_t(channel)];
    if (albedo == 0) return 0;
    return albedo * (std::exp(-r_mm / d) + std::exp(-r_mm / (3 * d))) / (8 * pi * d * r_mm);
}
double light_within(const BurleyProfile& burley, int channel, double r_mm) {
    const double x = r_mm / burley.d_mm[size_t(channel)];
    return -burley.albedo[size_t(channel)] * (0.25 * std::expm1(-x) + 0.75 * std::expm1(-x / 3));
}
double mean_radius_times_albedo(const BurleyProfile& burley, int channel) {
    return burley.albedo[size_t(channel)] * 2.5 * burley.d_mm[size_t(channel)];
}
double mean_square_times_albedo(const BurleyProfile& burley, int channel) {
    return burley.albedo[size_t(channel)] * 14 * square(burley.d_mm[size_t(channel)]);
}

// The cubic in exp(-r/3d) solved by Cardano: Golubev 2018, Efficient Screen-Space Subsurface Scattering.
double burley_inverse_cdf_mm(double d_mm, double u) {
    const double rest = 1 - u;
    const double g = 1 + 4 * rest * (2 * rest + std::sqrt(1 + 4 * square(rest)));
    const double root = std::cbrt(g);
    return std::max(0.0, 3 * d_mm * std::log((1 + root + 1 / root) / (4 * rest)));
}

// ---- Dipole ----------------------------------------------------------------------------------------------

// One real source below the surface and its mirror image above; both contribute z (1 + s d) exp(-s d) / d^3
// with s = sigma_tr and d = sqrt(r^2 + z^2).
struct Dipole {
    double half_albedo;  // alpha' / 2
    double sigma_tr_per_mm;
    double z_mm[2];
};

Dipole dipole_of(const DipoleProfile& profile, int channel) {
    const ScatteringMedium& medium = profile.medium;
    const double fdr = diffuse_internal_reflectance(medium.eta);
    const double boundary = (1 + fdr) / (1 - fdr);
    const double depth = 1 / reduced_sigma_t_per_mm(medium, channel);
    return {reduced_albedo(medium, channel) / 2,
            1 / diffuse_mean_free_path_mm(medium, channel),
            {depth, depth * (1 + 4.0 / 3.0 * boundary)}};
}

Result<void> check_model(const DipoleProfile& profile) {
    DERMIS_TRY(check(profile.medium));
    double largest = 0;
    for (int c = 0; c < 3; ++c) {
        const double sigma_a = profile.medium.sigma_a_per_mm[size_t(c)];
        if (!(sigma_a > 0)) return out_of_range("sigma_a_per_mm of " + channel_name(c), sigma_a, "> 0");
        largest = std::max(largest, profile.medium.sigma_s_per_mm[size_t(c)]);
    }
    if (largest == 0) return Error{"sigma_s_per_mm is 0 in all channels; one must be > 0"};
    return {};
}

template <class OfSource>
double over_sources(const DipoleProfile& profile, int channel, OfSource of_source) {
    const Dipole dipole = dipole_of(profile, channel);
    return dipole.half_albedo * (of_source(dipole.sigma_tr_per_mm, dipole.z_mm[0]) +
                                 of_source(dipole.sigma_tr_per_mm, dipole.z_mm[1]));
}

double albedo_of(const DipoleProfile& profile, int channel) {
    return over_sources(profile, channel, [](double s, double z) { return std::exp(-s * z); });
}
double reflectance_of(const DipoleProfile& profile, int channel, double r_mm) {
    return over_sources(profile, channel,
                        [&](double s, double z) {
                            const double d = std::hypot(r_mm, z);
                            return z * (1 + s * d) * std::exp(-s * d) / (d * d * d);
                        }) /
           (2 * pi);
}
// r dr = d dd, and exp(-s d) / d has the derivative -(1 + s d) exp(-s d) / d^2.
double light_within(const DipoleProfile& profile, int channel, double r_mm) {
    return over_sources(profile, channel, [&](double s, double z) {
        const double d = std::hypot(r_mm, z);
        return std::exp(-s * z) - z / d * std::exp(-s * d);
    });
}
// The integral of the light beyond r: int z exp(-s d) / d dr = z K_0(s z).
double mean_radius_times_albedo(const DipoleProfile& profile, int channel) {
    return over_sources(profile, channel,
                        [](double s, double z) { return z * std::cyl_bessel_k(0.0, s * z); });
}
// Twice the integral of r times the light beyond r: 2 z int exp(-s d) dd from z.
double mean_square_times_albedo(const DipoleProfile& profile, int channel) {
    return over_sources(profile, channel, [](double s, double z) { return 2 * z * std::exp(-s * z) / s; });
}

// ---- Tables ----------------------------------------------------------------------------------------------

Result<void> check_model(const TabulatedProfile&) {
    return {};  // made by TabulatedProfile::make only
}
double albedo_of(const TabulatedProfile& table, int channel) {
    return table.moment_within(channel, 0, kInfinity);
}
double reflectance_of(const TabulatedProfile& table, int channel, double r_mm) {
    return table.reflectance_at(channel, r_mm);
}
double light_within(const TabulatedProfile& table, int channel, double r_mm) {
    return table.moment_within(channel, 0, r_mm);
}
double mean_radius_times_albedo(const TabulatedProfile& table, int channel) {
    return table.moment_within(channel, 1, kInfinity);
}
double mean_square_times_albedo(const TabulatedProfile& table, int channel) {
    return table.moment_within(channel, 2, kInfinity);
}

// ---- Lengths times a factor ------------------------------------------------------------------------------

GaussianSum scaled_model(GaussianSum sum, double factor) {
    for (GaussianTerm& term : sum.terms) term.variance_mm2 *= square(factor);
    return sum;
}
BurleyProfile scaled_model(BurleyProfile burley, double factor) {
    for (double& d : burley.d_mm) d *= factor;
    return burley;
}
DipoleProfile scaled_model(DipoleProfile dipole, double factor) {
    for (double& sigma : dipole.medium.sigma_s_per_mm) sigma /= factor;
    for (double& sigma : dipole.medium.sigma_a_per_mm) sigma /= factor;
    return dipole;
}
TabulatedProfile scaled_model(const TabulatedProfile& table, double factor) {
    return table.scaled(factor);
}

// The part u of the light lies within [low, high] throughout; 80 halvings reach the last bit.
double bisected_inverse_cdf_mm(const Profile& profile, int channel, double u) {
    double low = 0, high = std::max(1e-9, mean_radius_mm(profile, channel));
    while (cdf(profile, channel, high) < u && high < 1e300) low = high, high *= 2;
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (cdf(profile, channel, middle) < u ? low : high) = middle;
    }
    return high;
}

struct ProfileHash {
    Hasher& hasher;
    void add(std::span<const double> values) const { hasher.add(std::as_bytes(values)); }
    void operator()(const GaussianSum& sum) const {
        for (const GaussianTerm& term : sum.terms) {
            hasher.add(term.variance_mm2);
            add(term.weight);
        }
    }
    void operator()(const BurleyProfile& burley) const {
        add(burley.albedo);
        add(burley.d_mm);
        if (burley.g != 0) hasher.add(burley.g);
    }
    void operator()(const DipoleProfile& dipole) const {
        add(dipole.medium.sigma_s_per_mm);
        add(dipole.medium.sigma_a_per_mm);
        hasher.add(dipole.medium.g).add(dipole.medium.eta);
    }
    void operator()(const TabulatedProfile& table) const {
        add(table.r_mm());
        for (const Rgb& value : table.reflectance_per_mm2()) add(value);
    }
};

}  // namespace

std::string model_name(const Profile& profile) {
    constexpr const char* kNames[] = {"sum of Gaussians", "Burley", "dipole", "table"};
    return kNames[profile.model.index()];
}

Result<void> check(const Profile& profile) {
    const Result<void> checked = std::visit([](const auto& m) { return check_model(m); }, profile.model);
    if (!checked) return Error{"profile '" + profile.name + "': " + checked.error().message};
    return {};
}

double reflectance_per_mm2(const Profile& profile, int channel, double r_mm) {
    assert(r_mm >= 0);
    return std::visit([&](const auto& m) { return reflectance_of(m, channel, r_mm); }, profile.model);
}

double diffuse_albedo(const Profile& profile, int channel) {
    return std::visit([&](const auto& m) { return albedo_of(m, channel); }, profile.model);
}

double cdf(const Profile& profile, int channel, double r_mm) {
    if (!(r_mm >= 0)) return 0;
    const double albedo = diffuse_albedo(profile, channel);
    if (albedo <= 0 || r_mm == kInfinity) return 1;
    const double within =
        std::visit([&](const auto& m) { return light_within(m, channel, r_mm); }, profile.model);
    return std::clamp(within / albedo, 0.0, 1.0);
}

double inverse_cdf_mm(const Profile& profile, int channel, double u) {
    if (!(u > 0) || diffuse_albedo(profile, channel) <= 0) return 0;
    if (const auto* table = std::get_if<TabulatedProfile>(&profile.model); table && u >= 1)
        return table->r_mm().back();
    if (u >= 1) return kInfinity;
    if (const auto* burley = std::get_if<BurleyProfile>(&profile.model))
        return burley_inverse_cdf_mm(burley->d_mm[size_t(channel)], u);
    return bisected_inverse_cdf_mm(profile, channel, u);
}

double mean_radius_mm(const Profile& profile, int channel) {
    const double albedo = diffuse_albedo(profile, channel);
    if (albedo <= 0) return 0;
    return std::visit([&](const auto& m) { return mean_radius_times_albedo(m, channel); }, profile.model) /
           albedo;
}

double mean_square_radius_mm2(const Profile& profile, int channel) {
    const double albedo = diffuse_albedo(profile, channel);
    if (albedo <= 0) return 0;
    return std::visit([&](const auto& m) { return mean_square_times_albedo(m, channel); }, profile.model) /
           albedo;
}

double slab_transmittance(const Profile& profile, int channel, double thickness_mm) {
    return 1 - cdf(profile, channel, thickness_mm);
}

BurleyProfile burley_equivalent(const Profile& profile) {
    BurleyProfile burley;
    if (const auto* own = std::get_if<BurleyProfile>(&profile.model)) burley.g = own->g;
    if (const auto* dipole = std::get_if<DipoleProfile>(&profile.model)) burley.g = dipole->medium.g;
    for (int c = 0; c < 3; ++c) {
        burley.albedo[size_t(c)] = diffuse_albedo(profile, c);
        burley.d_mm[size_t(c)] = mean_radius_mm(profile, c) / 2.5;
    }
    return burley;
}

std::string hash_of(const Profile& profile) {
    Hasher hasher;
    hasher.add(profile.model.index());
    std::visit(ProfileHash{hasher}, profile.model);
    return hasher.hex();
}

Profile scaled(const Profile& profile, double factor) {
    assert(factor > 0);
    Profile result = profile;
    std::visit([&](auto& m) { m = scaled_model(m, factor); }, result.model);
    return result;
}

Rgb total_weight(std::span<const GaussianTerm> terms) {
    Rgb total = {};
    for (const GaussianTerm& term : terms)
        for (size_t c = 0; c < 3; ++c) total[c] += term.weight[c];
    return total;
}

Vec3 profile_transfer(const GaussianSum& profile, double x) {
    const Rgb total = total_weight(profile.terms);
    const auto share = [&](int c) {
        const double left = weighted(profile, c, [&](double v) { return std::exp(-v * x); });
        return total[size_t(c)] > 0 ? float(left / total[size_t(c)]) : 1.0f;
    };
    return {share(0), share(1), share(2)};
}

}  // namespace dermis::inline optics
