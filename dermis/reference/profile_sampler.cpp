#include "dermis/reference/profile_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/angle.h"

namespace dermis::inline reference {
namespace {

constexpr int kCells = 2048;
constexpr double kLeftOut = 1e-5;
// The smallest radius as a part of the largest; below it Burley's peak counts as flat.
constexpr double kLeastRatio = 1e-6;

bool reflects(const Profile& profile, int channel) {
    return diffuse_albedo(profile, channel) > 0;
}

// Expected square of the irradiance at distance r from x less the channel's exitance at x, up to a factor,
// where the irradiance has straight edges at random places: E|y - Z| - E|Z - Z'| / 2 with Z, Z' around x by
// the profile. Of a Gaussian the second term is 1/sqrt(2) of the mean radius; the first is near the root.
double square_of_difference(double r_mm, double mean_radius_mm) {
    return std::hypot(r_mm, mean_radius_mm) - mean_radius_mm / std::numbers::sqrt2;
}

}  // namespace

ProfileSampler::ProfileSampler(const Profile& profile, double width_scale) {
    double max_mm = 0, mean_mm[3] = {};
    for (int c = 0; c < 3; ++c) {
        if (!reflects(profile, c)) continue;
        max_mm = std::max(max_mm, inverse_cdf_mm(profile, c, 1 - kLeftOut));
        mean_mm[c] = mean_radius_mm(profile, c);
    }
    max_mm = std::max(max_mm, 1e-6);
    const double least_mm = max_mm * kLeastRatio, log_step = std::log(1 / kLeastRatio) / (kCells - 1);
    cells_per_log_ = float(1 / log_step);
    const double to_middle = std::exp(-log_step / 2);
    double share = 0, area_before = 0;
    for (int k = 0; k < kCells; ++k) {
        const double r = least_mm * std::exp(k * log_step);
        double variance = 0;
        Vec3 reflectance;
        float* channel_of[3] = {&reflectance.x, &reflectance.y, &reflectance.z};
        for (int c = 0; c < 3; ++c) {
            if (!reflects(profile, c)) continue;
            const double middle = reflectance_per_mm2(profile, c, r * to_middle);
            variance += middle * middle * square_of_difference(r * to_middle, mean_mm[c]);
            *channel_of[c] = float(r * reflectance_per_mm2(profile, c, r) / width_scale);
        }
        const double area = std::numbers::pi * r * r * width_scale * width_scale;
        radius_mm_.push_back(float(r * width_scale));
        radius_reflectance_.push_back(reflectance);
        density_.push_back(float(std::sqrt(variance)));
        share += std::sqrt(variance) * (area - area_before);
        cumulative_.push_back(float(share));
        area_before = area;
    }
    const float all = cumulative_.back();
    for (float& c : cumulative_) c /= all;
    for (float& d : density_) d /= all;
    guide_ = GuideTable(cumulative_);
    least_mm_ = radius_mm_.front();
    max_mm_ = radius_mm_.back();
    // Within a ring r R(r) is linear in log r; the trapezoid over r of 2 pi r R(r).
    total_ = radius_reflectance_.front() * (kPi * least_mm_);
    for (size_t k = 1; k < radius_mm_.size(); ++k)
        total_ += (radius_reflectance_[k - 1] + radius_reflectance_[k]) *
                  (kPi * (radius_mm_[k] - radius_mm_[k - 1]));
}

float ProfileSampler::cell_position(float r_mm) const {
    return std::log(r_mm / least_mm_) * cells_per_log_;
}

Vec3 ProfileSampler::reflectance(float r_mm) const {
    if (r_mm >= max_mm_) return {};
    const float r = std::max(r_mm, least_mm_);
    const float position = std::clamp(cell_position(r), 0.0f, float(kCells - 1) - 1e-3f);
    const auto cell = size_t(position);
    const float t = position - float(cell);
    return (radius_reflectance_[cell] * (1 - t) + radius_reflectance_[cell + 1] * t) * (1 / r);
}

float ProfileSampler::sample_radius_mm(float u) const {
    const auto [first, last] = guide_.range(u);
    const size_t end = std::min(last, cumulative_.size() - 1);
    const size_t cell =
        size_t(std::lower_bound(&cumulative_[first], &cumulative_[end], u) - cumulative_.data());
    const float below = cell == 0 ? 0 : cumulative_[cell - 1], share = cumulative_[cell] - below;
    const float t = share > 0 ? std::clamp((u - below) / share, 0.0f, 1.0f) : 0.5f;
    const float inner = cell == 0 ? 0 : radius_mm_[cell - 1], outer = radius_mm_[cell];
    return std::sqrt(inner * inner + t * (outer * outer - inner * inner));
}

float ProfileSampler::density_per_mm2(float r_mm) const {
    if (r_mm >= max_mm_) return 0;
    if (r_mm <= least_mm_) return density_.front();
    return density_[std::min(size_t(std::ceil(cell_position(r_mm))), size_t(kCells - 1))];
}

}  // namespace dermis::inline reference
