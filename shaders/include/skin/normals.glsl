// Small bumps: scattering evens out what a normal map has, in red more than in blue. The diffuse light is computed for
// the normal as mapped and for one from a smaller mip level, and the two are mixed a channel.
#ifndef DERMIS_SKIN_NORMALS_GLSL
#define DERMIS_SKIN_NORMALS_GLSL

// What a texel of the normal map covers on the skin, in mm, along the axis that is stretched more. Pass the derivatives
// over the pixel, along x and y, of the position in mm and of the texture coordinate times the map's size.
float texel_mm(vec3 p_dx, vec3 p_dy, vec2 texel_dx, vec2 texel_dy) {
    float area = texel_dx.x * texel_dy.y - texel_dx.y * texel_dy.x;
    vec3 p_du = p_dx * texel_dy.y - p_dy * texel_dx.y, p_dv = p_dy * texel_dx.x - p_dx * texel_dy.x;
    return sqrt(max(dot(p_du, p_du), dot(p_dv, p_dv))) / max(abs(area), 1e-8);
}

// Light is what scatters, so the answers to both normals are mixed, not the normals: a bump's lit side still counts
// where the mean normal has turned away. smooth_weight is 0 to 1.
vec3 blended_light(vec3 of_sharp_normal, vec3 of_smooth_normal, vec3 smooth_weight) {
    return mix(of_sharp_normal, of_smooth_normal, smooth_weight);
}

// Variance of the normals that a smoother read of a normal map covers, on both axes: over normals whose mean has length
// r it is 1 - r^2 (Toksvig 2005). What the sharp read covers counts as one normal. Pass both reads as they are, not
// normalised.
float bumps_variance(vec3 of_sharp_read, vec3 of_smooth_read) {
    return max(1.0 - dot(of_smooth_read, of_smooth_read) / dot(of_sharp_read, of_sharp_read), 0.0);
}

// How far N.L deviates over such bumps, 0 to 1; mean_n_dot_l, -1 to 1, is N.L of the smoother read. Where light grazes,
// bumps take in more than their mean normal does: those that face away get none, and not less. Light at one deviation
// above the mean and at one below, halved, is the mean of the bumps' light for any cubic (Gauss and Hermite's rule).
float bumps_deviation(float variance, float mean_n_dot_l) {
    return sqrt(0.5 * variance * max(1.0 - mean_n_dot_l * mean_n_dot_l, 0.0));
}

// The normal of a channel as published, mixed itself (Penner 2011). Both normals are normalised.
vec3 lerped_normal(vec3 n_sharp, vec3 n_smooth, float smooth_weight) {
    return normalize(mix(n_sharp, n_smooth, smooth_weight));
}

#endif
