#include "dermis/judge/captured.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dermis::inline judge {
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

// One channel of one pixel.
struct Texel {
    double t_a, t_b, s_a, s_b;
};

// A technique without noise has one picture for both halves.
struct Pictures {
    const Image &technique_a, &technique_b, &reference_a, &reference_b, &mask;

    template <class Use>
    void each(size_t channel, Use use) const {
        for (size_t i = 0; i < mask.pixel_count(); ++i) {
            if (mask.floats()[i] <= 0) continue;
            const size_t at = 3 * i + channel;
            use(Texel{technique_a.floats()[at], technique_b.floats()[at], reference_a.floats()[at],
                      reference_b.floats()[at]});
        }
    }
};

Sums sums_of(const Pictures& pictures, size_t channel) {
    Sums sums;
    pictures.each(channel, [&](const Texel& x) {
        sums.left += (x.t_a - x.s_a) * (x.t_b - x.s_b);
        sums.effect += x.s_a * x.s_b;
        sums.halves_squared += (x.s_a - x.s_b) * (x.s_a - x.s_b);
        ++sums.count;
    });
    return sums;
}

// The variance that noise gives the sum left - q * effect, q being their ratio. With S_a = S + e_a, T_a = T +
// f_a and d = T - S it is, a pixel,
//
//     (f_a + f_b) d - (e_a + e_b) (d + q S) + (f_a - e_a) (f_b - e_b) - q e_a e_b
//
// whose variance is 2 f d^2 + 2 e (d + q S)^2 + (e + f)^2 - 2 q e^2 + q^2 e^2, with e and f the variances of
// e_a and f_a. (S_a - S_b)^2 estimates 2 e, and its square 12 e^2 (a normal's fourth moment).
double variance_of_sum(const Pictures& pictures, size_t channel, double q) {
    double sum = 0;
    pictures.each(channel, [&](const Texel& x) {
        const double effect = 0.5 * (x.s_a + x.s_b), d = 0.5 * (x.t_a + x.t_b) - effect,
                     lever = d + q * effect;
        const double two_e = (x.s_a - x.s_b) * (x.s_a - x.s_b), two_f = (x.t_a - x.t_b) * (x.t_a - x.t_b);
        sum += two_f * d * d + two_e * lever * lever;
        sum += (two_e * two_e * (1 - q) * (1 - q) + two_f * two_f) / 12 + two_e * two_f / 2;
    });
    return sum;
}

// Noise can make the ratio negative; the share is then 1.
double share_of_ratio(double ratio) {
    return 1 - std::sqrt(std::max(ratio, 0.0));
}

CapturedShare share_of(const Sums& sums, double variance) {
    CapturedShare result{.effect_rms = std::sqrt(std::max(sums.effect / sums.count, 0.0)),
                         .reference_noise = std::sqrt(sums.halves_squared / sums.count / 4)};
    result.share = share_of_ratio(sums.ratio());
    const double reach = sums.effect > 0 ? kInterval * std::sqrt(variance) / sums.effect
                                         : std::numeric_limits<double>::infinity();
    result.error = 0.5 * (share_of_ratio(sums.ratio() - reach) - share_of_ratio(sums.ratio() + reach));
    return result;
}

Result<void> check(const Pictures& p) {
    for (const Image* image : {&p.technique_a, &p.technique_b, &p.reference_a, &p.reference_b}) {
        if (image->width != p.mask.width || image->height != p.mask.height || image->channels != 3)
            return Error{"effects and mask differ in size or are not RGB"};
        if (!std::ranges::all_of(image->floats(), [](float v) { return std::isfinite(v); }))
            return Error{"a picture of the effect holds NaN or infinity"};
    }
    if (std::ranges::none_of(p.mask.floats(), [](float v) { return v > 0; }))
        return Error{"the mask is empty: no pixel to measure the effect at"};
    return {};
}

Result<Captured> captured_of(const Pictures& pictures) {
    DERMIS_TRY(check(pictures));
    Captured result;
    std::array<Sums, 3> sums;
    Sums all;
    for (size_t c = 0; c < 3; ++c) all += sums[c] = sums_of(pictures, c);
    double variance = 0;
    for (size_t c = 0; c < 3; ++c) {
        result.channels[c] = share_of(sums[c], variance_of_sum(pictures, c, sums[c].ratio()));
        variance += variance_of_sum(pictures, c, all.ratio());
    }
    result.all = share_of(all, variance);
    result.pixels = size_t(sums[0].count);
    return result;
}

}  // namespace

bool CapturedShare::known() const {
    return std::isfinite(share) && error <= kKnownError * std::max(1.0, 1 - share);
}

Result<Captured> captured(const Image& technique_effect, const EffectHalves& reference, const Image& mask) {
    return captured_of({technique_effect, technique_effect, reference.a, reference.b, mask});
}

Result<Captured> captured(const EffectHalves& technique, const EffectHalves& reference, const Image& mask) {
    return captured_of({technique.a, technique.b, reference.a, reference.b, mask});
}

namespace {

// The variance that the reference's noise gives (sqrt(N_from) - sqrt(N_to)) / sqrt(D), with N the sum of
// (T - S_a) (T - S_b) of each picture and D that of S_a S_b. With d = T - S, S_a = S + e_a, to first order in
// N and D, a value adds
//
//     (e_a + e_b) (d_to / r_to - d_from / r_from - c S / D) / 2 + e_a e_b (1 / r_from - 1 / r_to - c / D) / 2
//
// with r = sqrt(N D) and c the change of the share. A pixel's channels come from the same paths.
double variance_of_change(const Image& from, const Image& to, const EffectHalves& reference,
                          const Image& mask, const CapturedShare& before, const CapturedShare& after,
                          double values) {
    constexpr double kLeast = 1e-6;  // of 1 - share
    const double sum_d = before.effect_rms * before.effect_rms * values,
                 r_from = std::max(1 - before.share, kLeast) * sum_d,
                 r_to = std::max(1 - after.share, kLeast) * sum_d,
                 change = (after.share - before.share) / sum_d;
    double variance = 0;
    for (size_t i = 0; i < mask.pixel_count(); ++i) {
        if (mask.floats()[i] <= 0) continue;
        double first = 0;
        for (size_t at = 3 * i; at < 3 * i + 3; ++at) {
            const double s_a = reference.a.floats()[at], s_b = reference.b.floats()[at],
                         effect = 0.5 * (s_a + s_b), noise = s_a - s_b, d_from = from.floats()[at] - effect,
                         d_to = to.floats()[at] - effect;
            const double product = noise * noise * (1 / r_from - 1 / r_to - change) / 2;
            first += noise * (d_to / r_to - d_from / r_from - change * effect) / 2;
            variance += product * product / 12;
        }
        variance += first * first;
    }
    return variance;
}

}  // namespace

Result<ShareChange> share_change(const Image& from, const Image& to, const EffectHalves& reference,
                                 const Image& mask) {
    DERMIS_TRY_ASSIGN(const Captured before, captured(from, reference, mask),
                      after = captured(to, reference, mask));
    if (!after) return after.error();
    const double variance =
        variance_of_change(from, to, reference, mask, before.all, after->all, 3 * double(before.pixels));
    return ShareChange{.change = after->all.share - before.all.share,
                       .error = kInterval * std::sqrt(variance)};
}

EffectNoise effect_noise(const EffectHalves& reference, const Image& mask) {
    Sums all;
    for (size_t c = 0; c < 3; ++c)
        all += sums_of({reference.a, reference.a, reference.a, reference.b, mask}, c);
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

Image mean_effect(const EffectHalves& reference) {
    Image mean = reference.a;
    for (size_t i = 0; i < mean.floats().size(); ++i)
        mean.floats()[i] = 0.5f * (reference.a.floats()[i] + reference.b.floats()[i]);
    return mean;
}

}  // namespace dermis::inline judge
