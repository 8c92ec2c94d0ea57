#pragma once
// The Beckmann table of the Kelemen/Szirmay-Kalos specular model, as d'Eon, Luebke 2007 (GPU Gems 3,
// section 14.3) use it.

#include "dermis/bake/table.h"

namespace dermis::inline bake {

/// exp(-tan^2(a) / m^2) / (m^2 cos^4(a)), cos(a) = n_dot_h: Beckmann, Spizzichino 1963 without the 1/pi,
/// which is how that model takes it. 0 at n_dot_h = 0 and, but for n_dot_h = 1, at m = 0 (the limits).
[[nodiscard]] double beckmann(double n_dot_h, double roughness);

enum class BeckmannLayout {
    linear,     ///< the values, at texel centres; needs a float format
    gems_8_bit  ///< value^0.1 / 2 at i/n and j/n, v = 0 at the bottom: published code's 8-bit texture
};

struct BeckmannOptions {
    int width = 256, height = 256;
    BeckmannLayout layout = BeckmannLayout::linear;
};

/// u = n_dot_h 0..1, v = roughness m 0..1; one channel. Error: the size.
[[nodiscard]] Result<Table> bake_beckmann(const BeckmannOptions& options);

}  // namespace dermis::inline bake
