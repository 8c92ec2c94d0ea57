#pragma once
// Internal to preintegration: the light that leaks past the terminator, for narrow lobes.

#include <array>

#include "dermis/optics/preintegration/lobe.h"

namespace dermis::inline optics::preintegration {

/// x = (2 sin(b/2))^2 = 2 (1 - sqrt(1 - t^2)), the squared chord of the elevation b on the unit circle,
/// without cancellation.
[[nodiscard]] inline double chord_squared(double sine) {
    return 2 * sine * sine / (1 + std::sqrt(std::max(0.0, 1 - sine * sine)));
}

/// F(t) = mean_cosine * max(0, t) + tail(|t|). Beyond reach() the tail is below 2e-10 / sqrt(kappa).
class LocalTail {
  public:
    /// concentration >= kSwitchConcentration (the error grows to 1e-9 there), finite.
    LocalTail(Construction construction, double concentration);

    /// sine >= 0, chord_squared of the same elevation.
    [[nodiscard]] double operator()(double sine, double chord_squared) const;
    [[nodiscard]] double reach() const { return 2 * kReach / concentration_; }

    static constexpr int kOrder = 12;

  private:
    static constexpr double kReach = 18;  // exponent at which the lobe is cut off

    double concentration_, half_mean_cosine_;
    std::array<double, kOrder> source_;    // the terminator's own light, powers of x
    std::array<double, kOrder> integral_;  // remainder of the partial integration, powers of x
};

}  // namespace dermis::inline optics::preintegration
