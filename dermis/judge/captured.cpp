#include "dermis/judge/captured.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace dermis {
namespace {

constexpr double kInterval = 1.96;  // standard errors on each side: 95 %
constexpr double kKnownError = 0.05;

// Sums over pixels of one channel, or of all three.
struct Sums {
    double left = 0;            // (T - S_a) (T - S_b)
    double effect = 0;          // S_a S_b
    double halves_squared = 0;  // (S_a - S_b)^2
    double count = 0;

    Sums& operator+=(const Sums& other) {
        left += other.left;
        effect += other.effect;
        halves_squared += other.halves_squared;
        count += other.count;
        return *this;
    }
    [[nodiscard]] double ratio() const {
        return effect > 0 ? left / effect : std::numeric_limits<double>::infinity();
    }
};

Sums sums_of(const Image& technique, const EffectHalves& truth, const Image& mask, size_t channel) {
    Sums sums;
    const std::span<const float> t = technique.floats(), a = truth.a.floats(), b = truth.b.floats();
    for (size_t i = 0; i < mask.pixel_count(); ++i) {
        if (mask.floats()[i] <= 0) continue;
        const size_t at = 3 * i + channel;
        const double halves = double(a[at]) - double(b[at]);
        sums.left += (double(t[at]) - double(a[at])) * (double(t[at]) - double(b[at]));
        sums.effect += double(a[at]) * double(b[at]);
        sums.halves_squared += halves * halves;
        ++sums.count;
    }
    return sums;
}

// The variance that noise gives the sum left - q * effect, q being their ratio. With S_a = S + e_a, S_b = S +
// e_b and d = T - S it is, a pixel,
//
//     -(e_a + e_b) (d + q S) + (1 - q) e_a e_b
//
// whose variance is (d + q S)^2 2 v + (1 - q)^2 v^2, v the variance of e_a. (S_a - S_b)^2 estimates 2 v, and
// its square 12 v^2 (a normal's fourth moment).
double variance_of_sum(const Image& technique, const EffectHalves& truth, const Image& mask, size_t channel,
                       double q) {
    double sum = 0;
    const std::span<const float> t = technique.floats(), a = truth.a.floats(), b = truth.b.floats();
    for (size_t i = 0; i < mask.pixel_count(); ++i) {
        if (mask.floats()[i] <= 0) continue;
        const size_t at = 3 * i + channel;
        const double effect = 0.5 * (double(a[at]) + double(b[at])), d = double(t[at]) - effect;
        const double halves = double(a[at]) - double(b[at]), doubled_variance = halves * halves;
        const double lever = d + q * effect;
        sum +=
            lever * lever * doubled_variance + (1 - q) * (1 - q) * doubled_variance * doubled_variance / 12;
    }
    return sum;
}

// Negative where noise alone makes it so: then all is captured as far as can be seen.
double share_of_ratio(double ratio) {
    return 1 - std::sqrt(std::max(ratio, 0.0));
}

CapturedShare share_of(const Sums& sums, double variance) {
    CapturedShare result{.effect_rms = std::sqrt(std::max(sums.effect / sums.count, 0.0)),
                         .truth_noise = std::sqrt(sums.halves_squared / sums.count / 4)};
    result.share = share_of_ratio(sums.ratio());
    const double reach = sums.effect > 0 ? kInterval * std::sqrt(variance) / sums.effect
                                         : std::numeric_limits<double>::infinity();
    result.error = 0.5 * (share_of_ratio(sums.ratio() - reach) - share_of_ratio(sums.ratio() + reach));
    return result;
}

Result<void> check(const Image& technique, const EffectHalves& truth, const Image& mask) {
    for (const Image* image : {&technique, &truth.a, &truth.b}) {
        if (image->width != mask.width || image->height != mask.height || image->channels != 3)
            return Error{"effects and mask differ in size or are not RGB"};
        if (!std::ranges::all_of(image->floats(), [](float v) { return std::isfinite(v); }))
            return Error{"a picture of the effect holds NaN or infinity"};
    }
    if (std::ranges::none_of(mask.floats(), [](float v) { return v > 0; }))
        return Error{"the mask is empty: no pixel to measure the effect at"};
    return {};
}

}  // namespace

bool CapturedShare::known() const {
    return std::isfinite(share) && error <= kKnownError * std::max(1.0, 1 - share);
}

Result<Captured> captured(const Image& technique_effect, const EffectHalves& truth, const Image& mask) {
    if (Result<void> good = check(technique_effect, truth, mask); !good) return good.error();
    Captured result;
    std::array<Sums, 3> sums;
    Sums all;
    for (size_t c = 0; c < 3; ++c) all += sums[c] = sums_of(technique_effect, truth, mask, c);
    double variance = 0;
    for (size_t c = 0; c < 3; ++c) {
        result.channels[c] =
            share_of(sums[c], variance_of_sum(technique_effect, truth, mask, c, sums[c].ratio()));
        variance += variance_of_sum(technique_effect, truth, mask, c, all.ratio());
    }
    result.all = share_of(all, variance);
    result.pixels = size_t(sums[0].count);
    return result;
}

EffectNoise effect_noise(const EffectHalves& truth, const Image& mask) {
    Sums all;
    for (size_t c = 0; c < 3; ++c) all += sums_of(truth.a, truth, mask, c);
    if (all.count == 0) return {};
    return {.effect_rms = std::sqrt(std::max(all.effect / all.count, 0.0)),
            .noise_rms = std::sqrt(all.halves_squared / all.count / 4)};
}

Image difference(const Image& a, const Image& b) {
    Image result(a.width, a.height, 3);
    for (size_t i = 0; i < result.pixel_count(); ++i)
        for (size_t c = 0; c < 3; ++c)
            result.floats()[3 * i + c] =
                a.floats()[size_t(a.channels) * i + c] - b.floats()[size_t(b.channels) * i + c];
    return result;
}

Image mean_effect(const EffectHalves& truth) {
    Image mean = truth.a;
    for (size_t i = 0; i < mean.floats().size(); ++i)
        mean.floats()[i] = 0.5f * (truth.a.floats()[i] + truth.b.floats()[i]);
    return mean;
}

}  // namespace dermis
