// The curvature that scattering sees, in 1/mm. S is the curvature tensor of the surface: symmetric, passed as its
// diagonal (xx, yy, zz) and its mixed elements (yz, xz, xy). To second order, light spread over a neighbourhood of
// variance v a direction sees N.L change by -S L across it, and its mean fall by v / 2 N.L |S|^2 (squares of all
// elements). A sphere of curvature k changes by k sin and falls by v k^2 cos, so the sphere for which both are the same
// has
//
//     k^2 = |S L|^2 + (N.L)^2 |S|^2 / 2
//
// At the terminator that is the turn of the normal towards the light, 1/r on a cylinder lit from its side, and k on a
// saddle of k and -k, whose mean curvature is 0. Light from all around has no direction: k^2 = |S|^2 / 2, the
// curvedness (Koenderink, van Doorn 1992). Signs drop out: where nothing casts a shadow, a concave surface scatters as
// its convex mould does.
#ifndef DERMIS_SKIN_CURVATURE_GLSL
#define DERMIS_SKIN_CURVATURE_GLSL

// |S|^2 / 2, in 1/mm^2.
float half_sum_of_squares(vec3 diagonal_per_mm, vec3 mixed_per_mm) {
    return 0.5 * dot(diagonal_per_mm, diagonal_per_mm) + dot(mixed_per_mm, mixed_per_mm);
}

// S times a direction.
vec3 tensor_times(vec3 diagonal_per_mm, vec3 mixed_per_mm, vec3 d) {
    vec3 m = mixed_per_mm;
    return diagonal_per_mm * d + vec3(m.z * d.y + m.y * d.z, m.z * d.x + m.x * d.z, m.y * d.x + m.x * d.y);
}

// For light from all around: 0 upwards.
float curvature_around(vec3 diagonal_per_mm, vec3 mixed_per_mm) {
    return sqrt(half_sum_of_squares(diagonal_per_mm, mixed_per_mm));
}

// For light from one direction: 0 upwards. n and to_light are normalised, in the tensor's space.
float curvature_towards(vec3 diagonal_per_mm, vec3 mixed_per_mm, vec3 n, vec3 to_light) {
    vec3 turn = tensor_times(diagonal_per_mm, mixed_per_mm, to_light);
    float n_dot_l = dot(n, to_light);
    return sqrt(dot(turn, turn) + n_dot_l * n_dot_l * half_sum_of_squares(diagonal_per_mm, mixed_per_mm));
}

// The tensor of a sphere of this curvature, where no more is known: its diagonal and its mixed elements.
vec3 sphere_diagonal(float curvature_per_mm, vec3 n) { return curvature_per_mm * (1.0 - n * n); }

vec3 sphere_mixed(float curvature_per_mm, vec3 n) {
    return -curvature_per_mm * vec3(n.y * n.z, n.x * n.z, n.x * n.y);
}

// The tensor in a frame of two tangents, from a map's value (dermis/rays/bake_map.h): mean curvature, half of
// t.S t less b.S b, and t.S b.
vec3 tangent_diagonal(vec3 per_mm, vec3 t, vec3 b) {
    return (per_mm.x + per_mm.y) * t * t + (per_mm.x - per_mm.y) * b * b + 2.0 * per_mm.z * t * b;
}

vec3 tangent_mixed(vec3 per_mm, vec3 t, vec3 b) {
    vec3 tt = vec3(t.y * t.z, t.x * t.z, t.x * t.y), bb = vec3(b.y * b.z, b.x * b.z, b.x * b.y);
    vec3 tb = vec3(t.y * b.z + t.z * b.y, t.x * b.z + t.z * b.x, t.x * b.y + t.y * b.x);
    return (per_mm.x + per_mm.y) * tt + (per_mm.x - per_mm.y) * bb + per_mm.z * tb;
}

// A tangent that follows from the normal alone, with cross(n, tangent) as the other one: in this frame
// packages store the tensor of a vertex. It has a seam at n.z = -1 only (Frisvad 2012).
vec3 vertex_tangent(vec3 n) {
    float a = n.x / max(1.0 + n.z, 1e-4);
    return normalize(vec3(1.0 - n.x * a, -n.y * a, -n.x));
}

// From derivatives over the pixel, of the normal and of the position in mm: how fast the normal turns over how fast the
// point moves (Penner 2011). Pass fwidth() of both. It sees the mesh's facets and depends on the camera's distance.
float curvature_from_derivatives(vec3 fwidth_n, vec3 fwidth_p_mm) {
    return clamp(length(fwidth_n), 0.0, 1.0) / length(fwidth_p_mm);
}

#endif
