// How much of uniform light a curved place of this skin returns, over flat skin, and how much more passes a thin part than by
// the profile.
#ifndef DERMIS_PACKAGE_GAIN_GLSL
#define DERMIS_PACKAGE_GAIN_GLSL

#include "shaders/include/skin/gain.glsl"

// What all diffuse light of skin is multiplied with. mean_curvature_per_mm is above 0 on convex skin.
vec3 gain(float mean_curvature_per_mm) {
    return gain_of_curvature(mean_curvature_per_mm, vec3(@gain_slope_mm@), vec3(@gain_length_mm@), vec3(@gain_bend_mm@));
}

// Of light through thin parts: how much more of it passes slabs than the profile says.
const vec3 kGainOfSlabs = vec3(@gain_of_slabs@);

// From derivatives over the pixel, to the right and down, of the position in mm and of the normal: half the trace of the
// second fundamental form over the first (do Carmo 1976, "Differential Geometry of Curves and Surfaces", section 3-3).
// 0 where a surface is seen from its edge.
float mean_curvature_from_derivatives(vec3 p_right_mm, vec3 p_down_mm, vec3 n_right, vec3 n_down) {
    float e = dot(p_right_mm, p_right_mm), f = dot(p_right_mm, p_down_mm), g = dot(p_down_mm, p_down_mm);
    float bends = dot(n_right, p_right_mm) * g - (dot(n_right, p_down_mm) + dot(n_down, p_right_mm)) * f +
                  dot(n_down, p_down_mm) * e;
    float area = e * g - f * f;
    return area > 0.0 ? 0.5 * bends / area : 0.0;
}

#endif
