// A shadow's edge as the light around the point has it: what enters there counts by the profile, where it is not blocked.
//
// In channel c the light that leaves is D = sum w V E over the places around, E the light that would enter, V the part of it
// that nothing blocks and w the profile. The tables and baked normals have sum w E; so what is left to know is V averaged by
// w E. The places lie on the quadric of the curvature tensor, where E is N.L of its normal.
//
// That quadric is no part of the mesh: its places are lifted off it, by more the farther they are, or bumps would shade
// themselves, and a shadow's edge moves with the lift. So the average is not taken as it is: its difference from the same
// average over the penumbra alone is added to the visibility at the point, whose edges are where they should be.
#ifndef DERMIS_GATHERED_SHADOW_GLSL
#define DERMIS_GATHERED_SHADOW_GLSL

#include "shaders/include/transmission.glsl"
#include "shaders/include/skin/curvature.glsl"
#include "techniques/preintegrated/tables.glsl"

// Of shares tried on the head scan and the bust; half as much or twice as much loses .01 to .05 of either.
const float kGatherLiftTexels = 2.25, kGatherLiftMm = 0.45;  // kGatherLiftSlope: constants.h
// Where the quadric gets less light than this part of what comes straight down, the few places that are lit would decide: the
// difference counts less. Half as much loses up to .01 of a head's share.
const float kGatherFaint = 0.3;
// Pixels whose diagonal is shorter share their taps.
const float kGatherTogetherMm = 0.7;

// The surface around the point: x towards the light, as far as that goes along it, and y across.
struct Quadric {
    vec3 n, x, y;                  // world
    vec2 cosine_sine;              // of the light to n
    float xx_per_mm, yy_per_mm, xy_per_mm;  // the curvature tensor
};

Quadric quadric_around(Surface s, vec3 to_light_world, vec3 across_light_world) {
    Quadric q;
    q.n = s.n_geometry_world;
    float cosine = dot(q.n, to_light_world);
    vec3 along = to_light_world - cosine * q.n;
    float sine = length(along);
    q.x = sine > 1e-3 ? along / sine : across_light_world;
    q.y = cross(q.n, q.x);
    q.cosine_sine = vec2(cosine, sine);
    vec3 bent_x = tensor_times(s.curvature_diagonal_per_mm, s.curvature_mixed_per_mm, q.x);
    vec3 bent_y = tensor_times(s.curvature_diagonal_per_mm, s.curvature_mixed_per_mm, q.y);
    q.xx_per_mm = dot(bent_x, q.x);
    q.yy_per_mm = dot(bent_y, q.y);
    q.xy_per_mm = dot(bent_x, q.y);
    return q;
}

// All four pixels of a quad come here together. Where they are near each other each takes a quarter of the taps. Every fourth
// comes first: where these and the filtered shadow agree that all is lit, or nothing, the others are not read.
vec3 gathered_visibility(Surface s, int light, vec3 to_light_world, float visibility) {
    LightSource source = light_source(light);
    vec3 up = abs(to_light_world.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 across_light_world = all_directional != 0 ? source.x_world : normalize(cross(up, to_light_world));
    Quadric q = quadric_around(s, to_light_world, across_light_world);
    vec3 here = shadow_map_position(source.light_view_projection, s.p_world_mm);
    vec3 step_x = shadow_map_step(source.light_view_projection, s.p_world_mm, here, q.x);
    vec3 step_y = shadow_map_step(source.light_view_projection, s.p_world_mm, here, q.y);
    if (all_directional != 0) step_y.z = 0.0;  // across the light
    vec3 step_n = shadow_map_step(source.light_view_projection, s.p_world_mm, here, q.n);
    here += max(kGatherLiftTexels * shadow_texel_mm, kGatherLiftMm) * step_n;
    // Beside the triangle a storage buffer is not everywhere loaded.
    vec3 right_mm = dFdxCoarse(s.p_world_mm), down_mm = dFdyCoarse(s.p_world_mm);
    bool together = one_light != 0 && dot(right_mm, right_mm) + dot(down_mm, down_mm) < kGatherTogetherMm * kGatherTogetherMm;
    int lane = (int(gl_FragCoord.x) & 1) + 2 * (int(gl_FragCoord.y) & 1);
    int first = together ? lane : 0, stride = together ? 4 : 1;
    vec4 lit = vec4(0.0);  // the fourth: of the penumbra alone, of whose weights the mean is 1
    vec3 all = vec3(0.0);
    for (int i = first; i < kShadowGatherTaps; i += stride) {
        if (i - first == kShadowFirstTaps) {
            // Red reaches farthest: its weight is 0 nowhere.
            if (any_of_quad(abs(lit.r - visibility * all.r)) == 0.0) return vec3(visibility);
        }
        vec4 weight = texelFetch(sampler2D(skin_rows, nearest_clamp), ivec2(i, kRowTapWeights), 0);
        vec3 d_mm = texelFetch(sampler2D(skin_rows, nearest_clamp), ivec2(i, kRowTapPlaces), 0).xyz;  // z: how far it is lifted
        vec2 bend = vec2(q.xx_per_mm * d_mm.x + q.xy_per_mm * d_mm.y, q.xy_per_mm * d_mm.x + q.yy_per_mm * d_mm.y);
        float n_dot_l = max(q.cosine_sine.x + q.cosine_sine.y * bend.x, 0.0);
        float rise_mm = d_mm.z - 0.5 * dot(d_mm.xy, bend);
        float v = shadow_depth_tap(source.shadow_map_index, here + d_mm.x * step_x + d_mm.y * step_y + rise_mm * step_n);
        all += n_dot_l * weight.rgb;
        lit += vec4(vec3(v * n_dot_l), v) * weight;
    }
    if (together) {
        lit = sum_of_quad(lane, lit);
        all = sum_of_quad(lane, vec4(all, 0.0)).rgb;
    }
    if (source.shadow_map_index < 0 || outside_shadow_map(here)) return vec3(visibility);
    const float kTaps = float(kShadowGatherTaps);
    float known = min(all.r / (kGatherFaint * kTaps), 1.0);
    return clamp(visibility + known * (lit.rgb / max(all, vec3(1e-5)) - lit.a / kTaps), 0.0, 1.0);
}

#endif
