// glTF 2.0, appendix C: step (C.2), linear (C.3), spherical linear (C.4) and cubic spline (C.5).

#include "dermis/mesh/gltf/sampler.h"

#include <algorithm>
#include <cmath>

namespace dermis::inline mesh::gltf {
namespace {

constexpr double kSmallAngle = 1e-6;  // radians; the arc is straight to the precision of a float

void normalize(std::vector<double>& q) {
    double squared = 0;
    for (const double v : q) squared += v * v;
    if (squared > 0)
        for (double& v : q) v /= std::sqrt(squared);
}

// The value of key `k`, or its tangent: part 0 arrives, 1 is the value, 2 leaves.
std::span<const float> key_value(const Keys& keys, size_t k, size_t part = 1) {
    const bool cubic = keys.interpolation == Interpolation::cubic_spline;
    return std::span(keys.values).subspan((cubic ? 3 * k + part : k) * keys.width, keys.width);
}

std::vector<double> arc(std::span<const float> a, std::span<const float> b, double t) {
    double cosine = 0;
    for (size_t i = 0; i < a.size(); ++i) cosine += double(a[i]) * b[i];
    const double sign = cosine < 0 ? -1 : 1, angle = std::acos(std::min(1.0, std::abs(cosine)));
    const bool straight = angle < kSmallAngle;
    const double of_a = straight ? 1 - t : std::sin((1 - t) * angle) / std::sin(angle),
                 of_b = sign * (straight ? t : std::sin(t * angle) / std::sin(angle));
    std::vector<double> value;
    for (size_t i = 0; i < a.size(); ++i) value.push_back(of_a * a[i] + of_b * b[i]);
    return value;
}

std::vector<double> spline(const Keys& keys, size_t k, double t, double length_s) {
    const double t2 = t * t, t3 = t2 * t;
    const auto v0 = key_value(keys, k), v1 = key_value(keys, k + 1);
    const auto leaves = key_value(keys, k, 2), arrives = key_value(keys, k + 1, 0);
    std::vector<double> value;
    for (size_t i = 0; i < keys.width; ++i)
        value.push_back((2 * t3 - 3 * t2 + 1) * v0[i] + length_s * (t3 - 2 * t2 + t) * leaves[i] +
                        (3 * t2 - 2 * t3) * v1[i] + length_s * (t3 - t2) * arrives[i]);
    return value;
}

std::vector<double> between(const Keys& keys, size_t k, double time_s, bool rotation) {
    const double start_s = keys.times_s[k], length_s = keys.times_s[k + 1] - start_s;
    const double t = (time_s - start_s) / length_s;
    if (keys.interpolation == Interpolation::cubic_spline) return spline(keys, k, t, length_s);
    const auto a = key_value(keys, k), b = key_value(keys, k + 1);
    if (rotation) return arc(a, b, t);
    std::vector<double> value;
    for (size_t i = 0; i < keys.width; ++i) value.push_back((1 - t) * a[i] + t * b[i]);
    return value;
}

}  // namespace

std::vector<double> sample(const Keys& keys, double time_s, bool rotation) {
    const auto after = std::ranges::upper_bound(keys.times_s, time_s, {}, [](float t) { return double(t); });
    const size_t next = size_t(after - keys.times_s.begin()), k = next == 0 ? 0 : next - 1;
    const bool held = next == 0 || next == keys.times_s.size() || keys.interpolation == Interpolation::step;
    const auto key = key_value(keys, k);
    std::vector<double> value =
        held ? std::vector<double>(key.begin(), key.end()) : between(keys, k, time_s, rotation);
    if (rotation) normalize(value);
    return value;
}

Keys linear_keys(const Keys& keys, double step_s, bool rotation) {
    if (keys.interpolation != Interpolation::cubic_spline) return keys;
    Keys linear = {.interpolation = Interpolation::linear, .width = keys.width};
    const auto add = [&](double time_s) {
        linear.times_s.push_back(float(time_s));
        for (const double value : sample(keys, time_s, rotation)) linear.values.push_back(float(value));
    };
    for (size_t k = 0; k + 1 < keys.times_s.size(); ++k) {
        const double start_s = keys.times_s[k], length_s = keys.times_s[k + 1] - start_s;
        // A cubic of any length is near so many chords.
        constexpr double kMostParts = 64;
        const int parts = int(std::clamp(std::ceil(length_s / step_s), 1.0, kMostParts));
        for (int i = 0; i < parts; ++i) add(start_s + length_s * i / parts);
    }
    add(keys.times_s.back());
    return linear;
}

}  // namespace dermis::inline mesh::gltf
