// The curvature that scattering sees. To second order, light spread over a neighbourhood of variance v a direction sees N.L
// change by -S L across it, S the curvature tensor, and its mean fall by v / 2 N.L |S|^2 (squares of all elements). A sphere
// of curvature k changes by k sin and falls by v k^2 cos, so the sphere for which both are the same has
//
//     k^2 = |S L|^2 + (N.L)^2 |S|^2 / 2
//
// At the terminator that is the turn of the normal towards the light, 1/r on a cylinder lit from its side, and k on a saddle
// of k and -k, whose mean curvature is 0. Light from all around has no direction: k^2 = |S|^2 / 2, the curvedness (Koenderink,
// van Doorn 1992). Signs drop out: where nothing casts a shadow, a concave surface scatters as the convex one of the same shape.
#ifndef DERMIS_PREINTEGRATED_CURVATURE_GLSL
#define DERMIS_PREINTEGRATED_CURVATURE_GLSL

#include "shaders/include/frame.glsl"
#include "techniques/preintegrated/constants.h"

float half_sum_of_squares(mat3 s) { return 0.5 * (dot(s[0], s[0]) + dot(s[1], s[1]) + dot(s[2], s[2])); }

float curvature_around(mat3 tensor_per_mm) {
    return min(sqrt(half_sum_of_squares(tensor_per_mm)), kMaxCurvaturePerMm);
}

float curvature_towards(mat3 tensor_per_mm, vec3 n_world, vec3 to_light_world) {
    vec3 turn = tensor_per_mm * to_light_world;
    float n_dot_l = dot(n_world, to_light_world);
    return min(sqrt(dot(turn, turn) + n_dot_l * n_dot_l * half_sum_of_squares(tensor_per_mm)), kMaxCurvaturePerMm);
}

mat3 isotropic_curvature(float curvature_per_mm, vec3 n_world) {
    return curvature_per_mm * (mat3(1.0) - outerProduct(n_world, n_world));
}

#endif
