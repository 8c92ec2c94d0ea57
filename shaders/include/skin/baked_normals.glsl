// Baked normals: for each channel the mean of the normals around a point, weighted by the profile
// (dermis/rays/diffused_normals.h; after Ma et al. 2007). Three texels of maps over the skin's atlas
// hold them: the direction of red's mean times 0.5 plus 0.5; what green's direction is apart from it,
// as signed square roots; and the spread of red's normals: red and green how it differs by direction,
// times 0.5 plus 0.5, blue the square root of 1 less the mean's length.
#ifndef DERMIS_SKIN_BAKED_NORMALS_GLSL
#define DERMIS_SKIN_BAKED_NORMALS_GLSL

// Texels without skin hold a direction of squared length 0.
const float kLeastDirection = 0.25;

// The mip level to read, from the derivatives over the pixel of the texture coordinate times the map's
// size: that of the narrow side of the pixel's footprint. At a silhouette the wide side covers the
// whole flank, and its level would hold the mean of that flank. The maps are blurred by the profile, so
// finer levels hardly alias.
float baked_level(vec2 texel_dx, vec2 texel_dy) {
    float area = texel_dx.x * texel_dy.y - texel_dx.y * texel_dy.x;
    return 0.5 * log2(max(area * area, 1e-12) / max(max(dot(texel_dx, texel_dx), dot(texel_dy, texel_dy)), 1e-12));
}

// 1 where the texel is of skin, 0 elsewhere.
float baked_skin(vec3 red_texel) {
    vec3 n = 2.0 * red_texel - 1.0;
    return step(kLeastDirection, dot(n, n));
}

// Directions, normalised; all normals and to_light are in the space of the maps, which is the mesh's.
vec3 baked_red(vec3 red_texel) {
    vec3 n = 2.0 * red_texel - 1.0;
    return n * inversesqrt(max(dot(n, n), kLeastDirection));
}

vec3 baked_green(vec3 n_red, vec3 green_texel) {
    vec3 apart = green_texel * (255.0 / 127.0) - 128.0 / 127.0;
    vec3 n = n_red + apart * abs(apart);
    return n * inversesqrt(max(dot(n, n), kLeastDirection));
}

// The mean with the pixel's own normal, which stands for what is narrower than a texel. shorter: 1 less
// the length of the stored mean. The result is shorter than 1 where the normals differ.
vec3 mean_normal(vec3 n_baked, float shorter, vec3 n_own, float own_weight) {
    return mix((1.0 - shorter) * n_baked, n_own, own_weight);
}

// What such a mean leaves of the second band of light from all around, to second order.
vec3 band_2_of_means(vec3 mean_length) {
    vec3 less = 1.0 - mean_length;
    return 1.0 - 3.0 * less + 3.0 * less * less;
}

// The spread of the normals along the light over that on a sphere: what the square of the curvature is
// multiplied with. n is red's direction, uneven is -1 to 1. The frame around n has a seam at n.y = -1
// only (Frisvad 2012, "Building an Orthonormal Basis from a 3D Unit Vector Without Normalization").
float spread_towards(vec3 n, vec2 uneven, vec3 to_light) {
    float a = 1.0 / max(1.0 + n.y, 1e-4), b = -n.x * n.z * a;
    float x = dot(vec3(1.0 - n.x * n.x * a, -n.x, b), to_light);
    float z = dot(vec3(b, -n.z, 1.0 - n.z * n.z * a), to_light);
    return max(1.0 + uneven.x * (x * x - z * z) + 2.0 * uneven.y * x * z, 0.0);
}

#endif
