#include "techniques/screen_space_burley/tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dermis::screen_space_burley {
namespace {

constexpr double kPartReached = 0.997;

double radius_at(double reach_mm, int i, int count) {
    const double x = double(i) / (count - 1);
    return reach_mm * x * x;
}

double part(const Profile& profile, int channel, double reach_mm, double r_mm) {
    return std::min(1.0, cdf(profile, channel, r_mm) / cdf(profile, channel, reach_mm));
}

double mean_part(const Profile& profile, double reach_mm, double r_mm) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += part(profile, c, reach_mm, r_mm);
    return sum / 3;
}

template <class Value>
std::vector<Texel> over_distance(double reach_mm, int count, Value value) {
    std::vector<Texel> texels(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) {
        Texel& texel = texels[size_t(i)];
        for (int c = 0; c < 3; ++c) texel[size_t(c)] = float(value(c, radius_at(reach_mm, i, count)));
        texel[3] = (texel[0] + texel[1] + texel[2]) / 3;
    }
    return texels;
}

}  // namespace

double reach_mm(const Profile& profile) {
    double reach = 0;
    for (int c = 0; c < 3; ++c)
        if (diffuse_albedo(profile, c) > 0) reach = std::max(reach, inverse_cdf_mm(profile, c, kPartReached));
    return reach > 0 && std::isfinite(reach) ? reach : 1;
}

std::vector<Texel> radial_density(const Profile& profile, double reach_mm, int count) {
    // Burley's R is infinite at 0, r R(r) is not.
    const double least_mm = reach_mm * 1e-9;
    return over_distance(reach_mm, count, [&](int c, double r_mm) {
        const double albedo = diffuse_albedo(profile, c), r = std::max(r_mm, least_mm);
        if (albedo <= 0) return 0.0;
        return 2 * std::numbers::pi * r * reflectance_per_mm2(profile, c, r) /
               (albedo * cdf(profile, c, reach_mm));
    });
}

std::vector<Texel> part_within(const Profile& profile, double reach_mm, int count) {
    return over_distance(reach_mm, count,
                         [&](int c, double r_mm) { return part(profile, c, reach_mm, r_mm); });
}

std::vector<float> radius_of_part(const Profile& profile, double reach_mm, int count) {
    std::vector<float> radii;
    for (int i = 0; i < count; ++i) {
        double low = 0, high = reach_mm;
        for (int step = 0; step < 50; ++step) {
            const double middle = (low + high) / 2;
            (mean_part(profile, reach_mm, middle) < double(i) / (count - 1) ? low : high) = middle;
        }
        radii.push_back(float(high));
    }
    return radii;
}

}  // namespace dermis::screen_space_burley
