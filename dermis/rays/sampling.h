#pragma once
// Directions and lengths drawn from the densities of light transport. u is uniform in [0, 1) or [0, 1)^2;
// directions are unit, local ones about +z. Every sampler here is chi-squared tested against its density.

#include "dermis/base/vec.h"

namespace dermis::inline rays {

/// Two unit vectors that make a right-handed base with the unit vector n. Duff et al. 2017, Building an
/// Orthonormal Basis, Revisited.
struct LocalFrame {
    Vec3 tangent, bitangent, normal;
    [[nodiscard]] Vec3 to_world(Vec3 local) const {
        return tangent * local.x + bitangent * local.y + normal * local.z;
    }
    [[nodiscard]] Vec3 to_local(Vec3 world) const {
        return {dot(world, tangent), dot(world, bitangent), dot(world, normal)};
    }
};
[[nodiscard]] LocalFrame frame_of(Vec3 normal);

/// Uniform in the unit disk, squares to sectors without tearing (Shirley, Chiu 1997).
[[nodiscard]] Vec2 sample_disk(Vec2 u);

/// Density cos(theta) / pi.
[[nodiscard]] Vec3 sample_cosine_hemisphere(Vec2 u);
/// Density 1 / (4 pi).
[[nodiscard]] Vec3 sample_sphere(Vec2 u);

/// The cosine of the angle to the direction of travel, density henyey_greenstein() * 2 pi; g in (-1, 1).
[[nodiscard]] float sample_henyey_greenstein_cosine(float u, float g);
/// Per steradian, for the cosine between the directions of travel before and after. Henyey, Greenstein 1941.
[[nodiscard]] float henyey_greenstein(float cosine, float g);
/// The direction after a collision.
[[nodiscard]] Vec3 sample_henyey_greenstein(Vec2 u, Vec3 direction, float g);

/// A free path of density sigma exp(-sigma t); sigma > 0 in 1/mm.
[[nodiscard]] float sample_exponential_mm(float u, float sigma_per_mm);

/// Microfacet normal as seen from the local direction `to_eye` (z > 0), alpha > 0. Heitz 2018, Sampling the
/// GGX Distribution of Visible Normals.
[[nodiscard]] Vec3 sample_ggx_visible_normal(Vec2 u, Vec3 to_eye, float alpha);
/// Its density per steradian of the half vector.
[[nodiscard]] float ggx_visible_normal_density(Vec3 half_vector, Vec3 to_eye, float alpha);

}  // namespace dermis::inline rays
