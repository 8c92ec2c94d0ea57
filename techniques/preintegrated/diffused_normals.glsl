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

#include "shaders/include/surface.glsl"
#include "techniques/preintegrated/tables.glsl"

uniform texture2D diffused_normals_red, diffused_normals_green, diffused_normals_uneven;

// 0 where no skin lies outside the atlas: the compiler then drops the curvature of the vertices.
layout(constant_id = 7) const int skin_outside_atlas = 1;

struct DiffusedNormals {
    vec3 n[3];       // of each channel, normalised
    vec3 mean_length;
    float k_per_mm;  // of the sphere that has red's length
    vec3 band_2;     // what is left of the cosine lobe's second band
    vec2 uneven;     // the spread around n[0] is [[1 + x, y], [y, 1 - x]] in the frame of n[0]
};

// Texels without skin hold a direction of length 0. UVs in other tiles have no texel.
const float kNoSkin = 0.25;

// The mip level of the narrow side of the pixel's footprint. At a silhouette the wide side covers the whole flank, and its
// level would hold the mean of that flank. The maps are blurred by the profile, so finer levels hardly alias.
float diffused_normals_level(vec2 uv, float texels) {
    vec2 x = dFdx(uv) * texels, y = dFdy(uv) * texels;
    float area = x.x * y.y - x.y * y.x;
    return 0.5 * log2(area * area / max(max(dot(x, x), dot(y, y)), 1e-12));
}

// own_weight, green_spread: dermis/optics/diffused_normals.h. Outside the atlas the surface is a sphere of around_per_mm.
DiffusedNormals read_diffused_normals(Surface s, vec3 own_weight, float green_spread, float around_per_mm, float level) {
    vec3 red = 2.0 * textureLod(sampler2D(diffused_normals_red, trilinear_clamp), s.atlas_uv, level).rgb - 1.0;
    vec4 green = textureLod(sampler2D(diffused_normals_green, trilinear_clamp), s.atlas_uv, level);
    vec2 uneven = 2.0 * textureLod(sampler2D(diffused_normals_uneven, trilinear_clamp), s.atlas_uv, level).rg - 1.0;
    vec3 apart = green.rgb * (255.0 / 127.0) - 128.0 / 127.0;
    float shorter = green.a * green.a;
    bool in_atlas = all(equal(clamp(s.atlas_uv, 0.0, 1.0), s.atlas_uv)) && dot(red, red) > kNoSkin;
    if (!in_atlas) own_weight = vec3(1.0);
    red *= inversesqrt(max(dot(red, red), kNoSkin));
    vec3 n_green = red + apart * abs(apart);
    n_green *= inversesqrt(max(dot(n_green, n_green), kNoSkin)) * (1.0 - green_spread * shorter);
    red *= 1.0 - shorter;
    vec3 mean[3] = vec3[3](mix(red, s.n_world, own_weight.r), mix(n_green, s.n_world, own_weight.g),
                           mix(n_green, s.n_world, own_weight.b));
    DiffusedNormals d;
    for (int c = 0; c < 3; ++c) {
        d.mean_length[c] = length(mean[c]);
        d.n[c] = mean[c] / d.mean_length[c];
    }
    vec2 sphere = sphere_of_mean(d.mean_length.r);
    d.k_per_mm = skin_outside_atlas == 0 || in_atlas ? sphere.x : around_per_mm;
    // The normals of green and blue differ little: the second band of a lobe of mean cosine 1 - x, to second order in x.
    vec3 less = 1.0 - d.mean_length;
    d.band_2 = vec3(sphere.y, 1.0 - 3.0 * less.gb + 3.0 * less.gb * less.gb);
    d.uneven = in_atlas ? uneven : vec2(0.0);
    return d;
}

// The spread along the light over the spread on the mean's sphere. The frame around n has a seam at n.y = -1 only
// (Frisvad 2012, "Building an Orthonormal Basis from a 3D Unit Vector Without Normalization").
float spread_towards(vec3 n, vec2 uneven, vec3 to_light_world) {
    float a = 1.0 / max(1.0 + n.y, 1e-4), b = -n.x * n.z * a;
    float x = dot(vec3(1.0 - n.x * n.x * a, -n.x, b), to_light_world);
    float z = dot(vec3(b, -n.z, 1.0 - n.z * n.z * a), to_light_world);
    return max(1.0 + uneven.x * (x * x - z * z) + 2.0 * uneven.y * x * z, 0.0);
}

vec3 falloff_of_diffused_normals(DiffusedNormals d, vec3 to_light_world, float max_per_mm) {
    float k = min(d.k_per_mm * sqrt(spread_towards(d.n[0], d.uneven, to_light_world)), max_per_mm);
    return vec3(profile_falloff(dot(d.n[0], to_light_world), k).r, profile_falloff(dot(d.n[1], to_light_world), k).g,
                profile_falloff(dot(d.n[2], to_light_world), k).b);
}

#endif
