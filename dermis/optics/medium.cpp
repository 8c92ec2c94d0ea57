#include "dermis/optics/medium.h"

#include <algorithm>
#include <cmath>

#include "dermis/optics/check_value.h"

namespace dermis::inline optics {

Result<void> check(const ScatteringMedium& medium) {
    for (int c = 0; c < 3; ++c) {
        const std::string channel = channel_name(c);
        const double sigma_s = medium.sigma_s_per_mm[size_t(c)], sigma_a = medium.sigma_a_per_mm[size_t(c)];
        if (!(sigma_s >= 0 && std::isfinite(sigma_s)))
            return out_of_range("sigma_s_per_mm of " + channel, sigma_s, ">= 0 and finite");
        if (!(sigma_a >= 0 && std::isfinite(sigma_a)))
            return out_of_range("sigma_a_per_mm of " + channel, sigma_a, ">= 0 and finite");
        if (!(sigma_s + sigma_a > 0))
            return out_of_range("sigma_t_per_mm of " + channel, sigma_s + sigma_a, "> 0");
    }
    if (!(medium.g > -1 && medium.g < 1)) return out_of_range("g", medium.g, "between -1 and 1");
    if (!(medium.eta >= 1 && medium.eta <= 3)) return out_of_range("eta", medium.eta, "1 to 3");
    return {};
}

double sigma_t_per_mm(const ScatteringMedium& medium, int channel) {
    return medium.sigma_s_per_mm[size_t(channel)] + medium.sigma_a_per_mm[size_t(channel)];
}

double reduced_sigma_s_per_mm(const ScatteringMedium& medium, int channel) {
    return medium.sigma_s_per_mm[size_t(channel)] * (1 - medium.g);
}

double reduced_sigma_t_per_mm(const ScatteringMedium& medium, int channel) {
    return reduced_sigma_s_per_mm(medium, channel) + medium.sigma_a_per_mm[size_t(channel)];
}

double single_scatter_albedo(const ScatteringMedium& medium, int channel) {
    return medium.sigma_s_per_mm[size_t(channel)] / sigma_t_per_mm(medium, channel);
}

double reduced_albedo(const ScatteringMedium& medium, int channel) {
    return reduced_sigma_s_per_mm(medium, channel) / reduced_sigma_t_per_mm(medium, channel);
}

double mean_free_path_mm(const ScatteringMedium& medium, int channel) {
    return 1 / sigma_t_per_mm(medium, channel);
}

double diffuse_mean_free_path_mm(const ScatteringMedium& medium, int channel) {
    return 1 /
           std::sqrt(3 * medium.sigma_a_per_mm[size_t(channel)] * reduced_sigma_t_per_mm(medium, channel));
}

double multiscatter_albedo(double single_scatter_albedo, double g) {
    const double s = std::sqrt((1 - single_scatter_albedo) / (1 - single_scatter_albedo * g));
    return (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s);
}

double single_scatter_albedo_of(double multiscatter_albedo, double g) {
    const double c = multiscatter_albedo;
    const double s = 4.09712 + 4.20863 * c - std::sqrt(9.59217 + 41.6808 * c + 17.7126 * c * c);
    // The rounded constants leave s(1) = -3e-5 and s(0) = 1.00001.
    const double s_clamped = std::clamp(s, 0.0, 1.0);
    return (1 - s_clamped * s_clamped) / (1 - g * s_clamped * s_clamped);
}

ScatteringMedium medium_of(const Rgb& albedo, const Rgb& mean_free_path_mm, double g, double eta) {
    ScatteringMedium medium{.g = g, .eta = eta};
    for (size_t c = 0; c < 3; ++c) {
        const double sigma_t = 1 / mean_free_path_mm[c];
        const double alpha = single_scatter_albedo_of(albedo[c], g);
        medium.sigma_s_per_mm[c] = alpha * sigma_t;
        medium.sigma_a_per_mm[c] = (1 - alpha) * sigma_t;
    }
    return medium;
}

}  // namespace dermis::inline optics
