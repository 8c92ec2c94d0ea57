#pragma once
// How much a smooth dielectric boundary reflects. Unpolarised light; eta is the index of refraction on the
// far side divided by that on the near side (skin from air 1.4, from inside 1 / 1.4), > 0. Cosines are to the
// normal on the near side, clamped to 0..1.

namespace dermis::inline optics {

/// Fresnel's equations: the mean of both polarisations; 1 under total internal reflection. Exact.
[[nodiscard]] double fresnel_dielectric(double cos_theta, double eta);

/// F0 + (1 - F0)(1 - cos)^5. Source: Schlick 1994, An Inexpensive BRDF Model, equation 24. For eta 1.4 it is
/// within 0.014 of fresnel_dielectric below 75 degrees and within 0.047 everywhere (worst at 84; tested).
[[nodiscard]] double fresnel_schlick(double cos_theta, double f0);

/// Reflectance at normal incidence, ((eta - 1) / (eta + 1))^2: 0.017 for 1.3, 0.0278 for 1.4.
[[nodiscard]] double f0_of_eta(double eta);

/// The part of diffuse light inside a medium of index eta >= 1 that its boundary sends back, as a fit to the
/// hemispherical integral: -1.440/eta^2 + 0.710/eta + 0.668 + 0.0636 eta. Source: Egan, Hilgeman 1979, as in
/// Jensen et al. 2001, section 2.1. Within 0.005 of the integral for eta 1.2 to 1.6 (tested).
[[nodiscard]] double diffuse_internal_reflectance(double eta);

/// The same for light from outside, integral of 2 cos F(cos, eta) dcos, by quadrature to 1e-6; eta >= 1.
[[nodiscard]] double diffuse_external_reflectance(double eta);

}  // namespace dermis::inline optics
