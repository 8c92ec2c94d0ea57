#include "engines/host_transmission.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catalog/catalog.h"
#include "dermis/image/colour.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"
#include "engines/host_scenes.h"
#include "support/sphere_pictures.h"

namespace dermis {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr Rgb kAlbedo = {0.48, 0.19, 0.11};
constexpr int kTexels = 256, kCosines = 512;

// The Gaussians that the packages' coefficients are of.
Profile gaussians_of(const std::string& name) {
    Profile profile = find_profile(name).value();
    profile.model = to_gaussian_sum(profile).sum;
    return profile;
}

// Of a slab: light spreads from both walls, normalised by all that a point of either receives (R over both).
double far_share(const Profile& profile, int channel, double thickness_mm) {
    const double through = slab_transmittance(profile, channel, thickness_mm);
    return through / (1 + through);
}

// Over N.L from -1 to 1.
std::vector<Rgb> diffuse_curve(const Profile& profile) {
    std::vector<Rgb> curve;
    for (int i = 0; i <= kCosines; ++i)
        curve.push_back(preintegrated_diffuse(std::get<GaussianSum>(profile.model), 2.0 * i / kCosines - 1,
                                              kHostRadiusMm, {}));
    return curve;
}

double at_cosine(const std::vector<Rgb>& curve, double n_dot_l, size_t c) {
    const double place = std::clamp((n_dot_l + 1) * 0.5 * kCosines, 0.0, kCosines - 1e-6);
    const auto i = size_t(place);
    return std::lerp(curve[i][c], curve[i + 1][c], place - double(i));
}

}  // namespace

bool is_overexposed(const Image& picture, int x, int y) {
    return picture.at(x, y, 0) == 1 || picture.at(x, y, 1) == 1 || picture.at(x, y, 2) == 1;
}

Vec3 to_light_behind() {
    const double yaw = kBehindYawDeg * kDegree, pitch = kBehindPitchDeg * kDegree;
    return {float(std::sin(yaw) * std::cos(pitch)), float(std::sin(pitch)),
            float(std::cos(yaw) * std::cos(pitch))};
}

Image thickness_ramp() {
    Image image(kTexels, 4, 3, PixelFormat::u8);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) image.set(x, y, c, float(x) / (kTexels - 1));
    return image;
}

float thickness_mm(float u) {
    return kThicknessMaxMm * std::clamp(u * kTexels - 0.5f, 0.0f, kTexels - 1.0f) / (kTexels - 1);
}

Image with_transmission(const Image& sphere, const std::string& profile_name) {
    const Profile profile = gaussians_of(profile_name);
    const std::vector<Rgb> curve = diffuse_curve(profile);
    const PackageGain gains = package_gain(find_profile(profile_name).value()).value();
    const SpherePixels pixels(sphere);
    const Vec3 to_light = to_light_behind();
    Image picture = sphere;
    for (int y = 0; y < sphere.height; ++y)
        for (int x = 0; x < sphere.width; ++x) {
            if (!pixels.is_inside(x, y) || is_overexposed(sphere, x, y)) continue;
            const Vec3 n = sphere_normal(x, y, sphere.width);
            const double n_dot_l = dot(n, to_light);
            const float u = std::atan2(n.x, n.z) / float(2 * std::numbers::pi) + 0.5f;
            for (int c = 0; c < 3; ++c) {
                const double here = at_cosine(curve, n_dot_l, size_t(c)), behind = std::max(-n_dot_l, 0.0);
                const double of_place = gain(gains.of_curvature, c, 1 / kHostRadiusMm);
                const double through = std::max(of_place, gains.of_slabs[size_t(c)]);
                const double radiance = kAlbedo[size_t(c)] * kBehindIntensity / std::numbers::pi *
                                        far_share(profile, c, thickness_mm(u)) *
                                        (behind * through - here * of_place);
                const double sum = srgb_decode(sphere.at(x, y, c)) + radiance;
                picture.set(x, y, c, srgb_encode(float(std::clamp(sum, 0.0, 1.0))));
            }
        }
    return picture;
}

Vec3 sheet_color_srgb(const std::string& profile_name) {
    const Profile profile = gaussians_of(profile_name);
    const PackageGain gains = package_gain(find_profile(profile_name).value()).value();
    float color[3];
    for (int c = 0; c < 3; ++c)
        color[c] = float(kAlbedo[size_t(c)] * kBehindIntensity / std::numbers::pi * -to_light_behind().z *
                         far_share(profile, c, thickness_mm(kSheetU)) * gains.of_slabs[size_t(c)]);
    return srgb_encode(Vec3{color[0], color[1], color[2]});
}

float shadow_edge_x_mm() {
    const Vec3 to_light = to_light_behind();
    const float z_mm = 0.5f * thickness_mm(kSheetU);
    return kBoardEdgeMm - to_light.x / to_light.z * (kBoardZMm - z_mm);
}

}  // namespace dermis
