#pragma once
// Internal: Gauss-Legendre rules on [0, 1], by Newton iteration on the Legendre polynomial (Press et al.
// 2007, Numerical Recipes, section 4.6); nodes to about 1e-15.

#include <array>
#include <cmath>
#include <numbers>

namespace dermis::inline optics::preintegration {

template <int Count>
class GaussLegendre {
  public:
    GaussLegendre() {
        for (int i = 0; i < Count; ++i) {
            double x = std::cos(std::numbers::pi * (i + 0.75) / (Count + 0.5)), derivative = 1;
            for (int step = 0; step < 8; ++step) {
                double previous = 1, current = x;
                for (int l = 2; l <= Count; ++l) {
                    const double next = ((2 * l - 1) * x * current - (l - 1) * previous) / l;
                    previous = current;
                    current = next;
                }
                derivative = Count * (x * current - previous) / (x * x - 1);
                x -= current / derivative;
            }
            node_[i] = 0.5 * (1 - x);
            weight_[i] = 1 / ((1 - x * x) * derivative * derivative);
        }
    }
    [[nodiscard]] static constexpr size_t size() { return Count; }
    [[nodiscard]] double node(size_t i) const { return node_[i]; }
    [[nodiscard]] double weight(size_t i) const { return weight_[i]; }

  private:
    std::array<double, Count> node_, weight_;
};

}  // namespace dermis::inline optics::preintegration
