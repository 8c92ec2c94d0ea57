// Diffuse light by spherical Gaussians (Pettineo 2020, "Approximating Subsurface Scattering with Spherical Gaussians").
// A Gaussian of variance v, taken along the chord of a sphere of radius r, is the lobe exp(-kappa (1 - cos x)), kappa =
// r^2 / v. So light that it scatters is the clamped cosine blurred by that lobe, which is the irradiance that a light
// as wide as the lobe gives. Normalised: the lobe's integral over the sphere is 1.
#ifndef DERMIS_SKIN_SPHERICAL_GAUSSIANS_GLSL
#define DERMIS_SKIN_SPHERICAL_GAUSSIANS_GLSL

// Hill's fit diverges below (0.19 off at 0.7).
const float kLeastSharpness = 1.5;
// Half the width of the band around the terminator that the lobe blurs, over its deviation. Hill's, 1 / (4 0.36^2),
// suits wide lobes. With it a narrow lobe scatters 24 % too much light; the width of least error falls to the other.
const float kHillWidth = 1.929, kNarrowWidth = 1.678;

// Irradiance over irradiance at normal incidence, 0 to 1 a channel; n_dot_l from -1 to 1, kappa above 0. Stephen Hill's
// fit of 2016 (Pettineo, "SG Series Part 3: Diffuse Lighting From an SG Light Source"): at most 0.015 off from 1.5 up.
// Below, the lobe is replaced by that of 1.5 and the whole sphere, whose light is 1/4, in the proportion that the mean
// cosine, kappa / 3 - kappa^3 / 45, asks for: at most 0.018 off.
vec3 lobe_light(float n_dot_l, vec3 kappa) {
    vec3 sharpness = max(kappa, kLeastSharpness), low = min(kappa, kLeastSharpness);
    vec3 inverse = 1.0 / sharpness, e = exp(-sharpness), e2 = e * e;
    vec3 reach = sqrt(inverse - 2.0 * e2) * min(vec3(kHillWidth), kNarrowWidth + inverse);
    // A parabola from -reach to reach around the terminator, a line beyond.
    vec3 crossing = clamp(n_dot_l + reach, vec3(0.0), 2.0 * reach);
    vec3 lit = crossing * crossing / (4.0 * reach) + max(n_dot_l - reach, 0.0);
    vec3 blurred = (1.0 + 2.0 * e2 - inverse) * lit + (e - e2) * inverse - e2;
    vec3 part = low * (15.0 - low * low) / (kLeastSharpness * (15.0 - kLeastSharpness * kLeastSharpness));
    return mix(vec3(0.25), blurred, part);
}

#endif
