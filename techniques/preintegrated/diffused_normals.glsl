// Diffuse light from baked normals: for each channel the mean of the normals over the profile
// (dermis/rays/diffused_normals.h).
//
// On a sphere of curvature k the mean is the point's own normal with length A(k), the mean cosine of the profile. So the
// direction of the mean gives N.L, and the length of red's gives the curvature (the inverse of A). Both address the diffuse
// table; on a sphere the result is the table without baked normals. On other shapes the odd part of the light, half of
// A N.L, is the cosine of the mean and therefore exact. The even part, which sets the width of the terminator, is that of a
// sphere whose normals spread as much.
//
// On a cylinder or a saddle the normals spread more along one direction. The spread along the light counts, as in
// shaders/include/skin/curvature.glsl: k^2 times (the spread along L + (N.L)^2); on a sphere the spread is 1 - (N.L)^2.
// The curvature of the vertices is not read, because the mean contains it.
#ifndef DERMIS_DIFFUSED_NORMALS_GLSL
#define DERMIS_DIFFUSED_NORMALS_GLSL

#include "shaders/include/skin/baked_normals.glsl"
#include "shaders/include/surface.glsl"
#include "techniques/preintegrated/tables.glsl"

uniform texture2D diffused_normals_red, diffused_normals_green, diffused_normals_uneven;

// 0 where no skin lies outside the atlas: the compiler then drops the curvature of the vertices.
layout(constant_id = 7) const int skin_outside_atlas = 1;

struct DiffusedNormals {
    vec3 n[3];       // of each channel, normalised
    vec3 mean_length;
    float k_per_mm;  // curvature of the sphere whose mean normal is as long as red's
    vec3 band_2;     // what is left of the cosine lobe's second band
    vec2 uneven;     // the spread around n[0] is [[1 + x, y], [y, 1 - x]] in the frame of n[0]
};

// UVs in other tiles have no texel.
float diffused_normals_level(vec2 uv, float texels) { return baked_level(dFdx(uv) * texels, dFdy(uv) * texels); }

// own_weight, green_spread: dermis/optics/diffused_normals.h. Outside the atlas the surface is a sphere of around_per_mm.
DiffusedNormals read_diffused_normals(Surface s, vec3 own_weight, float green_spread, float around_per_mm, float level) {
    vec3 red = textureLod(sampler2D(diffused_normals_red, trilinear_clamp), s.atlas_uv, level).rgb;
    vec4 green = textureLod(sampler2D(diffused_normals_green, trilinear_clamp), s.atlas_uv, level);
    vec2 uneven = 2.0 * textureLod(sampler2D(diffused_normals_uneven, trilinear_clamp), s.atlas_uv, level).rg - 1.0;
    float shorter = green.a * green.a;
    bool in_atlas = all(equal(clamp(s.atlas_uv, 0.0, 1.0), s.atlas_uv)) && baked_skin(red) > 0.0;
    if (!in_atlas) own_weight = vec3(1.0);
    vec3 n_red = baked_red(red), n_green = baked_green(n_red, green.rgb);
    vec3 mean[3] = vec3[3](mean_normal(n_red, shorter, s.n_world, own_weight.r),
                           mean_normal(n_green, green_spread * shorter, s.n_world, own_weight.g),
                           mean_normal(n_green, green_spread * shorter, s.n_world, own_weight.b));
    DiffusedNormals d;
    for (int c = 0; c < 3; ++c) {
        d.mean_length[c] = length(mean[c]);
        d.n[c] = mean[c] / d.mean_length[c];
    }
    vec2 sphere = sphere_of_mean(d.mean_length.r);
    d.k_per_mm = skin_outside_atlas == 0 || in_atlas ? sphere.x : around_per_mm;
    // The normals of green and blue differ little.
    d.band_2 = vec3(sphere.y, band_2_of_means(d.mean_length).gb);
    d.uneven = in_atlas ? uneven : vec2(0.0);
    return d;
}

vec3 falloff_of_diffused_normals(DiffusedNormals d, vec3 to_light_world, float max_per_mm) {
    float k = min(d.k_per_mm * sqrt(spread_towards(d.n[0], d.uneven, to_light_world)), max_per_mm);
    return vec3(profile_falloff(dot(d.n[0], to_light_world), k).r, profile_falloff(dot(d.n[1], to_light_world), k).g,
                profile_falloff(dot(d.n[2], to_light_world), k).b);
}

#endif
