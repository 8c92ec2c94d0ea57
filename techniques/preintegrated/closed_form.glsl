// shaders/include/skin/closed_form.glsl with the coefficients of the scene's profile, which are expressions of curvature
// (dermis/optics/curvature_expressions.h), as are the zonal harmonics. No table is read.
#ifndef DERMIS_CLOSED_FORM_GLSL
#define DERMIS_CLOSED_FORM_GLSL

#include "techniques/preintegrated/skin.glsl"

vec3 closed_form(vec3 t, float k) {
    float u = knee_of(k);
    return line_and_hyperbola(t, 0.5 + polynomial(form_a, u), 0.5 + polynomial(form_s, u),
                              k * (form_q[0] + u * form_q[1]), polynomial(form_k0, u), polynomial(form_k1, u));
}

void closed_form_zonal(float k, out vec3 zh[3]) {
    float u = knee_of(k);
    zh[0] = 0.886226925 + polynomial(zonal_0, u);
    zh[1] = 1.023326708 + polynomial(zonal_1, u);
    zh[2] = 0.495415912 + polynomial(zonal_2, u);
}

// A shadow's edge over visibility (dermis/optics/edge_expression.h).
vec3 scattered_edge(float visibility) {
    return edge_of_hyperbolas(visibility, edge[0], edge[1], edge[2], edge[3], edge[4], edge_width2[0], edge[5], edge_width2[1]);
}

#endif
