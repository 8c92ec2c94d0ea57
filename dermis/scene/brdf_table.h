#pragma once
// The second factor of the split sum: what a GGX surface reflects of a constant white environment, as
// F0 * scale + bias (Karis 2013, "Real Shading in Unreal Engine 4"), with height-correlated Smith masking
// (Heitz 2014, equation 99) and Schlick's Fresnel term.

#include <cstddef>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"

namespace dermis {

/// {scale, bias} for perceptual roughness (alpha = roughness^2) and n.v, both in 0..1. The default agrees
/// with dense quadrature to 0.002.
///
/// The common analytic fit (Karis 2014, "Physically Based Shading on Mobile") is off by up to 0.08 in the
/// reflectance of skin (F0 0.028) and by 20 % at roughness 0.3, n.v 0.3: hence a table.
[[nodiscard]] Vec2 ggx_scale_and_bias(float roughness, float n_dot_v, int samples = 512);

/// The same as a square image, rg16f, rows of n.v from left to right, roughness from top to bottom, at texel
/// centres (i + 0.5) / size. 64 x 64 takes 40 ms on one core; bilinear lookups between its texels are within
/// 0.004 for roughness above 0.1 and n.v above 0.05.
[[nodiscard]] std::vector<std::byte> make_brdf_table(int size);

/// The one that shaders read, from the disk cache when it holds it.
inline constexpr int kBrdfTableSize = 64;
[[nodiscard]] Result<std::vector<std::byte>> stored_brdf_table();

}  // namespace dermis
