#include "dermis/optics/gain_form.h"

#include <algorithm>
#include <cmath>

#include "dermis/optics/fresnel.h"

namespace dermis::inline optics {
namespace {

constexpr double kLeastSlopeMm = 1e-3, kLeastLengthMm = 1e-3;

// Of diffuse light inside that arrives at the boundary, by the midpoint rule.
double diffuse_reflectance_from_inside(double eta) {
    if (eta == 1) return 0;
    constexpr int kSteps = 4096;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double cosine = (i + 0.5) / kSteps;
        sum += 2 * cosine * fresnel_dielectric(cosine, 1 / eta) / kSteps;
    }
    return sum;
}

struct Channel {
    double slope_mm, length_mm, bend_mm;
};

// Small bodies return everything: v tends to 1 / length, so slope / (length - bend) = 1 / albedo - 1.
Channel channel_of(double slope_mm, double length_mm, double albedo) {
    return {slope_mm, length_mm, length_mm - slope_mm * albedo / (1 - albedo)};
}

// `concave`: the factor on the length on concave skin, 0 of a ball-shaped cavity.
double gain_of(const Channel& form, double curvature_per_mm, double concave) {
    const double h = curvature_per_mm * form.length_mm * (curvature_per_mm < 0 ? concave : 1);
    const double v = curvature_per_mm / std::sqrt(1 + h * h);
    const double rest = 1 - form.bend_mm * v;
    return rest > 0 ? std::max(1 + form.slope_mm * v / rest, 0.0) : 0;
}

double misfit(const Channel& form, std::span<const GainSample> samples, size_t c) {
    double sum = 0;
    for (const GainSample& sample : samples) {
        const double wanted = sample.gain[c];
        const double off = (gain_of(form, sample.curvature_per_mm, 0) - wanted) / std::max(1.0, wanted);
        sum += off * off;
    }
    return sum;
}

// A pattern search in the logarithms of slope and length: the misfit is smooth and has one minimum.
Channel fit_channel(std::span<const GainSample> samples, size_t c, double albedo) {
    double slope = 1, length = 1, best = misfit(channel_of(slope, length, albedo), samples, c);
    for (double step = 1; step > 1e-4;) {
        bool better = false;
        for (const auto& [x, y] :
             {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
            const double new_slope = std::max(slope * std::exp(x * step), kLeastSlopeMm);
            const double new_length = std::max(length * std::exp(y * step), kLeastLengthMm);
            const double now = misfit(channel_of(new_slope, new_length, albedo), samples, c);
            if (!(now < best)) continue;
            best = now, slope = new_slope, length = new_length, better = true;
            break;
        }
        if (!better) step /= 2;
    }
    return channel_of(slope, length, albedo);
}

}  // namespace

double gain(const GainForm& form, int channel, double curvature_per_mm) {
    const auto c = size_t(channel);
    return gain_of({form.slope_mm[c], form.length_mm[c], form.bend_mm[c]}, curvature_per_mm, kGainFold);
}

GainForm fit_gain_form(std::span<const GainSample> samples, const Rgb& albedo) {
    GainForm form;
    for (size_t c = 0; c < 3; ++c) {
        if (!(albedo[c] > 0 && albedo[c] < 1)) continue;
        const Channel fitted = fit_channel(samples, c, albedo[c]);
        form.slope_mm[c] = fitted.slope_mm;
        form.length_mm[c] = fitted.length_mm;
        form.bend_mm[c] = fitted.bend_mm;
    }
    return form;
}

double diffusion_gain_slope_mm(const ScatteringMedium& medium, int channel, double half_space_albedo) {
    const double d = 1 / (3 * reduced_sigma_t_per_mm(medium, channel));
    const double length = diffuse_mean_free_path_mm(medium, channel);
    const double r = diffuse_reflectance_from_inside(medium.eta);
    const double extrapolated = 2 * d * (1 + r) / (1 - r);
    const double stretch = 1 + extrapolated / length;
    return 4 * d / ((1 - r) * stretch * stretch * half_space_albedo);
}

}  // namespace dermis::inline optics
