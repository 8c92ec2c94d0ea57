// Gaussians over a distance through the skin, in mm.
#ifndef DERMIS_SKIN_TRANSMISSION_GLSL
#define DERMIS_SKIN_TRANSMISSION_GLSL

// exp(-d^2 / 2v), 0 to 1, of a Gaussian of variance v: exponent_per_mm2 is -1 / (2 v log 2).
float gaussian_falloff(float distance_mm, float exponent_per_mm2) {
    return exp2(exponent_per_mm2 * distance_mm * distance_mm);
}

// The same for a variance a channel.
vec3 gaussian_falloff_rgb(float distance_mm, vec3 exponent_per_mm2) {
    return vec3(gaussian_falloff(distance_mm, exponent_per_mm2.x), gaussian_falloff(distance_mm, exponent_per_mm2.y),
                gaussian_falloff(distance_mm, exponent_per_mm2.z));
}

#endif
