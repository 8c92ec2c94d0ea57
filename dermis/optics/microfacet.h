#pragma once
// Reflection of rough surfaces: distributions of microfacet normals, shadowing, and the BRDFs skin is
// rendered with. Vectors enter as cosines: n the normal, l to the light, v to the viewer, h the normalised
// half vector. alpha is the roughness of the distribution (perceptual roughness squared), > 0; Beckmann's m
// is the same number. Every D is per steradian with the integral of D(h) (n.h) over the hemisphere = 1
// (tested). BRDFs are per steradian, without the cosine.

namespace dermis::inline optics {

/// Walter, Marschner, Li, Torrance 2007, Microfacet Models for Refraction, equation 33.
[[nodiscard]] double ggx_d(double n_dot_h, double alpha);
/// Beckmann, Spizzichino 1963; Walter et al. 2007, equation 25.
[[nodiscard]] double beckmann_d(double n_dot_h, double alpha);
/// Blinn 1977 with the (s + 2) / (2 pi) that makes it a distribution; exponent s >= 0.
[[nodiscard]] double blinn_phong_d(double n_dot_h, double exponent);
/// The exponent whose lobe matches Beckmann's near the normal: 2 / alpha^2 - 2 (Walter et al. 2007, section
/// 5.2); 0 for alpha >= 1.
[[nodiscard]] double blinn_phong_exponent(double alpha);

/// Smith's masking of one direction, 0..1. Exact for the distribution: the visible facets' projected area is
/// n.v (tested). Heitz 2014, Understanding the Masking-Shadowing Function, equations 43, 66, 72.
[[nodiscard]] double ggx_smith_g1(double n_dot_v, double alpha);
[[nodiscard]] double beckmann_smith_g1(double n_dot_v, double alpha);
/// Height-correlated masking and shadowing, Heitz 2014, equation 99.
[[nodiscard]] double ggx_smith_g(double n_dot_l, double n_dot_v, double alpha);
[[nodiscard]] double beckmann_smith_g(double n_dot_l, double n_dot_v, double alpha);

/// D G F / (4 n.l n.v), 0 when either direction is below the surface. Cook, Torrance 1982, with Walter's 4.
[[nodiscard]] double microfacet_brdf(double d, double g, double fresnel, double n_dot_l, double n_dot_v);

/// D F / (4 (l.h)^2): the shadowing term of Kelemen, Szirmay-Kalos 2001, A Microfacet Based Coupled
/// Specular-Matte BRDF Model, equation 11 (G / (n.l n.v) taken as 1 / (l.h)^2). With D = beckmann_d; the code
/// of GPU Gems 3, section 14.3, leaves out the 1 / pi of D and is pi times brighter.
[[nodiscard]] double kelemen_szirmay_kalos_brdf(double d, double fresnel, double l_dot_h);

/// A rough matte surface relative to Lambert's: multiply by albedo / pi. sigma_rad is the standard deviation
/// of the facets' slope angle, 0 (Lambert, 1 everywhere) to about 1. Oren, Nayar 1994, Generalization of
/// Lambert's Reflectance Model, equation 30 (the qualitative model, without interreflection). Loses up to 26
/// % of the light at sigma 0.6 (normal incidence) and can reach 1.1 at grazing angles: it is not energy
/// conserving.
[[nodiscard]] double oren_nayar(double n_dot_l, double n_dot_v, double l_dot_v, double sigma_rad);

}  // namespace dermis::inline optics
