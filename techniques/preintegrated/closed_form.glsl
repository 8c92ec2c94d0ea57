// Pre-integrated diffuse light as a line and a hyperbola: D = (a t + s sqrt(q^2 + t^2) + k0 + k1 t^2) / 2, five colours
// of curvature alone (dermis/optics/closed_form.h). Error against the integral for r from 1 mm: 0.0017.
#ifndef DERMIS_CLOSED_FORM_GLSL
#define DERMIS_CLOSED_FORM_GLSL

// Halves of a, s, k0, k1; q in the fourth channels of the first three.
struct ClosedForm {
    vec4 a, s, k0, k1;
};

ClosedForm read_closed_form(texture2D table, sampler linear_clamp_sampler, float curvature_coordinate) {
    return ClosedForm(textureLod(sampler2D(table, linear_clamp_sampler), vec2(curvature_coordinate, 0.125), 0.0),
                      textureLod(sampler2D(table, linear_clamp_sampler), vec2(curvature_coordinate, 0.375), 0.0),
                      textureLod(sampler2D(table, linear_clamp_sampler), vec2(curvature_coordinate, 0.625), 0.0),
                      textureLod(sampler2D(table, linear_clamp_sampler), vec2(curvature_coordinate, 0.875), 0.0));
}

vec3 closed_form(ClosedForm c, vec3 t) {
    vec3 q = vec3(c.a.a, c.s.a, c.k0.a), t2 = t * t;
    return c.a.rgb * t + c.s.rgb * sqrt(q * q + t2) + c.k0.rgb + c.k1.rgb * t2;
}

#endif
