#pragma once
// Skin tones I to VI, and what a little more melanin or blood does to a skin's colour.

#include "dermis/base/vec.h"

namespace dermis::inline image {

/// Mean albedo of the bare skin of tone 1 to 6 (clamped), linear sRGB; between two, straight in CIELAB.
/// Tones IV to VI have the lightness of OpenPBR's skin examples; I to III are darkened in even steps, because
/// those examples are lighter than faces. Hue and chroma follow measurements of faces: redness hardly
/// differs, yellowness rises from fair to brown skin and falls in dark skin (Xiao et al. 2017). docs/bust.md
/// has both tables.
[[nodiscard]] Vec3 skin_tone_albedo_linear(double tone);

/// The albedo with more (or less, if negative) melanin and blood than it has: each multiplies it by
/// exp(-amount * absorption), a linear step in the logarithm (Tsumura et al. 2003, Image-based skin color and
/// texture analysis/synthesis). Absorption is relative to green's: melanin's falls as wavelength^-3.33
/// (Jacques 1998), blood's is that of haemoglobin, three quarters of it with oxygen; at 610, 545 and 465 nm.
/// An amount of 0.1 takes 10 % of green.
[[nodiscard]] Vec3 with_pigments(Vec3 albedo_linear, float melanin, float blood);

}  // namespace dermis::inline image
