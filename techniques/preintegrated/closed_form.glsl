// Pre-integrated diffuse light as a line and a hyperbola: D = (a t + s sqrt(q^2 + t^2) + k0 + k1 t^2) / 2, whose five colours
// are expressions of curvature (dermis/optics/curvature_expressions.h), as are the zonal harmonics. No table is read.
#ifndef DERMIS_CLOSED_FORM_GLSL
#define DERMIS_CLOSED_FORM_GLSL

#include "techniques/preintegrated/skin.glsl"

vec3 closed_form(vec3 t, float k) {
    float u = knee_coordinate(k);
    vec3 q = k * fma(form_q[1], vec3(u), form_q[0]), t2 = t * t;
    vec3 a = 0.5 + polynomial(form_a, u), s = 0.5 + polynomial(form_s, u);
    return a * t + s * sqrt(q * q + t2) + polynomial(form_k0, u) + polynomial(form_k1, u) * t2;
}

void closed_form_zonal(float k, out vec3 zh[3]) {
    float u = knee_coordinate(k);
    zh[0] = 0.886226925 + polynomial(zonal_0, u);
    zh[1] = 1.023326708 + polynomial(zonal_1, u);
    zh[2] = 0.495415912 + polynomial(zonal_2, u);
}

// A shadow's edge over visibility (dermis/optics/edge_expression.h).
vec3 scattered_edge(float visibility) {
    float y = 2.0 * visibility - 1.0, y2 = y * y;
    vec3 sum = edge[0] + edge[1] * y2 + edge[2] * sqrt(max(1.0 - y2, 0.0)) + edge[3] * inversesqrt(y2 + edge_width2[0]) +
               edge[4] * inversesqrt(y2 + edge_width2[1]);
    return 0.5 + 0.5 * y * sum;
}

#endif
