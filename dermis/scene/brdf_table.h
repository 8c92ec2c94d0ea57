#pragma once
// The share of a constant white environment that a lobe reflects, as F0 * scale + bias: the second factor of
// the split sum (Karis 2013, "Real Shading in Unreal Engine 4"), and by reciprocity the part of light from
// one direction that is reflected at all. Fresnel is Schlick's.
//
// - GGX with height-correlated Smith masking (Heitz 2014, equation 99)
// - Kelemen/Szirmay-Kalos over Beckmann's distribution (shaders/include/skin/specular.glsl)

#include <cstddef>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "shaders/include/constants.h"

namespace dermis::inline scene {

/// {scale, bias} for perceptual roughness (alpha = roughness^2) and n.v, both in 0..1. The default agrees
/// with dense quadrature to 0.002.
///
/// The common analytic fit (Karis 2014, "Physically Based Shading on Mobile") is off by up to 0.08 in the
/// reflectance of skin (F0 0.028) and by 20 % at roughness 0.3, n.v 0.3: hence a table.
[[nodiscard]] Vec2 ggx_scale_and_bias(float roughness, float n_dot_v, int samples = 512);

[[nodiscard]] Vec2 ksk_scale_and_bias(float roughness, float n_dot_v, int samples = 512);

/// The same as an image, rgba16f: a square for each lobe below each other (kBrdfLobeGgx, ...), rows of n.v
/// from left to right, roughness from top to bottom, at texel centres (i + 0.5) / size. Red and green are
/// scale and bias; blue and alpha their means over the hemisphere, weighted by the cosine, the same in a
/// whole row. 64 x 64 takes 40 ms a lobe on one core; bilinear lookups between its texels are within 0.004
/// for roughness above 0.1 and n.v above 0.05.
[[nodiscard]] std::vector<std::byte> make_brdf_table(int size);

/// The one that shaders read, of kBrdfTableSize, from the disk cache when it holds it.
[[nodiscard]] Result<std::vector<std::byte>> stored_brdf_table();

/// It, read as shaders read it.
class BrdfTable {
  public:
    [[nodiscard]] static Result<BrdfTable> load();

    /// Scale, bias and their means.
    [[nodiscard]] Vec4 at(int lobe, float roughness, float cosine) const;

  private:
    std::vector<std::byte> texels_;
};

}  // namespace dermis::inline scene
