// Pre-integrated diffuse light without a table: over N.L a line and a hyperbola, whose five colours are polynomials of
// curvature; a shadow's edge as a polynomial, two hyperbolas and a root. The coefficients are fitted to a profile.
#ifndef DERMIS_SKIN_CLOSED_FORM_GLSL
#define DERMIS_SKIN_CLOSED_FORM_GLSL

// Curvature of 0 to 1 per mm as the polynomials take it, 0 to 1: a wide profile changes most at small curvatures. knee
// is in 1/mm.
float knee_coordinate(float curvature_per_mm, float knee) {
    return curvature_per_mm * (1.0 + knee) / (curvature_per_mm + knee);
}

// x p0 + x^2 p1 + ... + x^6 p5: 0 on flat skin, where x is 0.
vec3 polynomial_6(float x, vec3 p0, vec3 p1, vec3 p2, vec3 p3, vec3 p4, vec3 p5) {
    return x * (p0 + x * (p1 + x * (p2 + x * (p3 + x * (p4 + x * p5)))));
}

// Radiant exitance over irradiance at normal incidence, about 0 to 1; N.L from -1 to 1, one a channel. Flat skin has
// a = s = 1/2 and 0 for the rest, which is Lambert's: (t + |t|) / 2.
vec3 line_and_hyperbola(vec3 n_dot_l, vec3 a, vec3 s, vec3 q, vec3 k0, vec3 k1) {
    vec3 t2 = n_dot_l * n_dot_l;
    return a * n_dot_l + s * sqrt(q * q + t2) + k0 + k1 * t2;
}

// Light of 0 to 1 in a penumbra, where the shadow's filter has visibility 0 to 1. narrow2 and wide2 are squared widths
// of the hyperbolas, as parts of the penumbra's half; the root is for the ends, where a disk's share starts steeply.
vec3 edge_of_hyperbolas(float visibility, vec3 slope, vec3 cubic, vec3 quintic, vec3 root, vec3 narrow,
                        vec3 narrow2, vec3 wide, vec3 wide2) {
    float y = 2.0 * visibility - 1.0, y2 = y * y;
    vec3 sum = slope + y2 * (cubic + y2 * quintic) + root * sqrt(max(1.0 - y2, 0.0)) +
               narrow * inversesqrt(y2 + narrow2) + wide * inversesqrt(y2 + wide2);
    return 0.5 + 0.5 * y * sum;
}

#endif
