// What skin of a mean curvature returns of uniform light, over flat skin (docs/transport.md). More
// paths leave a convex body before they are absorbed, fewer a concave one. dermis/optics/gain_form.h has the terms
// and the error.
#ifndef DERMIS_SKIN_GAIN_GLSL
#define DERMIS_SKIN_GAIN_GLSL

// Concave skin is in folds, narrower than the ways of the light, which average over the skin beside them: there the
// curvature counts less, as that of convex skin with ways so many times longer. As in dermis/optics/gain_form.h.
const float kGainFold = 5.0;

// curvature_per_mm: the mean curvature, above 0 on convex skin. Convex skin of a small radius returns at most
// 1 / albedo.
vec3 gain_of_curvature(float curvature_per_mm, vec3 slope_mm, vec3 length_mm, vec3 bend_mm) {
    vec3 h = (curvature_per_mm < 0.0 ? kGainFold * curvature_per_mm : curvature_per_mm) * length_mm;
    vec3 v = curvature_per_mm * inversesqrt(1.0 + h * h);
    return max(1.0 + slope_mm * v / max(1.0 - bend_mm * v, 1e-3), vec3(0.0));
}

// What light through a thin part is multiplied with. gain_of_slabs: how much more of it passes slabs than the
// profile says, one number a channel (dermis/rays/slab_gain.h).
vec3 gain_through(vec3 gain_of_place, vec3 gain_of_slabs) { return max(gain_of_place, gain_of_slabs); }

// Diffuse light of a thin part: what has entered here and on its far side, each 0 to 1, and the share of the
// latter (skin_far_share()).
vec3 thin_light(vec3 here, vec3 behind, vec3 share_behind, vec3 gain_of_place, vec3 gain_of_slabs) {
    return here * (1.0 - share_behind) * gain_of_place +
           behind * share_behind * gain_through(gain_of_place, gain_of_slabs);
}

#endif
