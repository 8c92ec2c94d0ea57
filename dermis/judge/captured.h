#pragma once
// Captured share: how much of what scattering does to a picture a technique does too.
//
//     S = S_t - L_t    effect of scattering: the reference with the skin's profile, less that of width 0
//     T = T_r - L_r    effect of the technique: its picture less the baseline's, by the same renderer
//
//     share = 1 - sqrt((<|T - S|^2> - n^2) / (<|S|^2> - n^2))
//
// <> is the mean over pixels and channels, n^2 the variance of S. The baseline has 0, the reference 1, a
// technique that does harm less than 0. What both renderers get wrong cancels in the differences.
//
// The reference comes in two independent halves S_a and S_b of equal size. With S = (S_a + S_b) / 2 and
//
//     n^2 = <|S_a - S_b|^2> / 4
//
// both brackets are exactly
//
//     <|T - S|^2> - n^2 = <(T - S_a) (T - S_b)>        <|S|^2> - n^2 = <S_a S_b>
//
// so nothing is assumed of the noise but that the halves do not share it. A technique that is noisy itself
// comes in halves too: <(T_a - S_a) (T_b - S_b)>.

#include <array>
#include <optional>

#include "dermis/base/result.h"
#include "dermis/image/image.h"

namespace dermis::inline judge {

/// Two independent estimates of an effect, f32 RGB, of one size.
struct EffectHalves {
    Image a, b;
};

struct CapturedShare {
    double share = 0;
    /// Half the width of its 95 % interval: how far another seed of the reference may move it. From the
    /// spread of the halves at every pixel, whose noise is independent.
    double error = 0;
    double effect_rms = 0;       ///< of S, its noise taken out
    double reference_noise = 0;  ///< n

    /// Whether it may be printed: the reference is fine enough for an interval of at most 0.05 to each side,
    /// or a twentieth of 1 - share where that is more.
    [[nodiscard]] bool known() const;
};

/// Over the pixels where the mask is above 0.
struct Captured {
    CapturedShare all;                      ///< of the three channels together; red is most of the effect
    std::array<CapturedShare, 3> channels;  ///< red, green, blue
    size_t pixels = 0;
};

/// Errors: sizes that differ, NaN, an empty mask.
[[nodiscard]] Result<Captured> captured(const Image& technique_effect, const EffectHalves& reference,
                                        const Image& mask);

/// Share of a technique that is noisy itself, such as another reference; its noise drops out too.
[[nodiscard]] Result<Captured> captured(const EffectHalves& technique, const EffectHalves& reference,
                                        const Image& mask);

/// How the captured share changes from one picture of a technique to another.
struct ShareChange {
    double change = 0;
    /// Half of its 95 % interval. Both shares have the noise of one reference, which hardly counts where the
    /// pictures are equal.
    double error = 0;
};
/// Errors: as captured().
[[nodiscard]] Result<ShareChange> share_change(const Image& from, const Image& to,
                                               const EffectHalves& reference, const Image& mask);

/// RMS of the effect and of its noise alone, for deciding how long the reference must go on.
struct EffectNoise {
    double effect_rms = 0, noise_rms = 0;
};
[[nodiscard]] EffectNoise effect_noise(const EffectHalves& reference, const Image& mask);

/// a - b of the first three channels of linear f32 images, as RGB.
[[nodiscard]] Image difference(const Image& a, const Image& b);

/// The mean of both halves.
[[nodiscard]] Image mean_effect(const EffectHalves& reference);

}  // namespace dermis::inline judge
