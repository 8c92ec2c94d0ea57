#include "dermis/reference/environment_sampler.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/angle.h"
#include "dermis/image/colour.h"
#include "dermis/scene/panorama.h"

namespace dermis::inline reference {
namespace {

// Solid angle per unit of the uv square at this height: 2 pi wide, pi high, times the sine of the
// polar angle.
float uv_solid_angle(float v) {
    return 2 * kPi * kPi * std::max(std::sin(kPi * v), 1e-6f);
}

}  // namespace

Result<EnvironmentSampler> EnvironmentSampler::load(const Environment& environment) {
    EnvironmentSampler sampler;
    sampler.intensity_ = environment.intensity;
    sampler.turn_ = {std::cos(environment.yaw_rad), std::sin(environment.yaw_rad)};
    if (environment.kind == EnvironmentKind::none || environment.intensity <= 0) return sampler;
    DERMIS_TRY_ASSIGN(Image panorama, load_panorama(environment));
    sampler.panorama_ = std::move(panorama);
    sampler.sh_ = project_radiance(sampler.panorama_);
    const Image& image = sampler.panorama_;
    const std::span<const float> texels = image.floats();
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            // Bilinear lookups spread a texel's light over its neighbours, so no texel may go without
            // samples.
            const float* t = &texels[3 * (size_t(y) * size_t(image.width) + size_t(x))];
            sum += (double(luminance(Vec3{t[0], t[1], t[2]})) + 1e-4) * panorama_texel_solid_angle(image, y);
            sampler.cumulative_.push_back(sum);
        }
    for (double& share : sampler.cumulative_) share /= sum;
    sampler.cumulative_.back() = 1;
    sampler.guide_ = GuideTable(sampler.cumulative_);
    return sampler;
}

Vec3 EnvironmentSampler::to_world(Vec3 d) const {
    return to_environment(d, {turn_.cosine, -turn_.sine});
}

Vec3 EnvironmentSampler::radiance(Vec3 d_world) const {
    if (dark()) return {};
    return radiance_at(place(d_world));
}

Vec2 EnvironmentSampler::place(Vec3 d_world) const {
    return panorama_uv(to_environment(d_world, turn_));
}

Vec3 EnvironmentSampler::radiance_at(Vec2 place) const {
    return panorama_radiance(panorama_, place) * intensity_;
}

Vec3 EnvironmentSampler::harmonic_irradiance(Vec3 n_world) const {
    if (dark()) return {};
    const Vec3 e = sh_irradiance(sh_, to_environment(n_world, turn_)) * intensity_;
    return {std::max(e.x, 0.0f), std::max(e.y, 0.0f), std::max(e.z, 0.0f)};
}

EnvironmentSampler::Sample EnvironmentSampler::sample(Vec2 u) const {
    const auto [first, last] = guide_.range(u.x);
    const size_t end = std::min(last, cumulative_.size() - 1);
    const size_t texel =
        size_t(std::upper_bound(&cumulative_[first], &cumulative_[end], u.x) - cumulative_.data());
    const double below = texel == 0 ? 0 : cumulative_[texel - 1];
    const auto share = float(cumulative_[texel] - below);
    const auto width = size_t(panorama_.width);
    // The remainder of u.x within the texel's share is uniform again.
    const float across = share > 0 ? std::clamp(float(u.x - below) / share, 0.0f, 1.0f) : 0.5f;
    const Vec2 place = {(float(texel % width) + across) / float(panorama_.width),
                        (float(texel / width) + u.y) / float(panorama_.height)};
    const float texels = float(panorama_.pixel_count());
    return {.direction_world = to_world(panorama_direction(place.x, place.y)),
            .place = place,
            .density = share * texels / uv_solid_angle(place.y)};
}

float EnvironmentSampler::density_at(Vec2 place) const {
    const int x = std::clamp(int(place.x * float(panorama_.width)), 0, panorama_.width - 1);
    const int y = std::clamp(int(place.y * float(panorama_.height)), 0, panorama_.height - 1);
    const size_t texel = size_t(y) * size_t(panorama_.width) + size_t(x);
    const double below = texel == 0 ? 0 : cumulative_[texel - 1];
    return float(cumulative_[texel] - below) * float(panorama_.pixel_count()) / uv_solid_angle(place.y);
}

}  // namespace dermis::inline reference
