// Shadow edges from the visibility around the point, weighted by the profile.
//
// The light that leaves in a channel is D = sum w V E over the places around: w is the profile, E the light that would
// enter, V the visible part of it. The tables and the baked normals hold sum w E. So the shader needs V averaged with the
// weights w E. The places lie on the quadric of the curvature tensor, and E is N.L of the quadric's normal.
//
// The quadric is not the mesh. The places are lifted off it, the farther ones by more, so that bumps do not shade
// themselves. The lift moves the edge of a shadow. Therefore the shader adds only the difference between this average and
// the same average over the penumbra alone to the visibility at the point.
#ifndef DERMIS_GATHERED_SHADOW_GLSL
#define DERMIS_GATHERED_SHADOW_GLSL

#include "shaders/include/transmission.glsl"
#include "shaders/include/skin/curvature.glsl"
#include "techniques/preintegrated/tables.glsl"

// Tuned for the captured share on the head scan and the bust; half or twice as much loses .01 to .05.
const float kGatherLiftTexels = 2.25, kGatherLiftMm = 0.45;  // kGatherLiftSlope: constants.h
// Where the quadric gets less than this part of the light of a facing surface, a few lit places would decide, so the
// difference counts in proportion. Half as much loses up to .01 of the share.
const float kGatherFaint = 0.3;
// Pixels whose diagonal is shorter share their taps.
const float kGatherTogetherMm = 0.7;

// The surface around the point: tangent x towards the light, tangent y across.
struct Quadric {
    vec3 n, x, y;                  // world
    vec2 cosine_sine;              // of the angle between the light and n
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

// All four pixels of a quad must call this together. Where they are near each other, each takes a quarter of the taps. Every
// fourth tap comes first: if these taps and the filtered shadow agree that all or nothing is lit, the rest is skipped.
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
    // Helper pixels beside the triangle may not load storage buffers.
    vec3 right_mm = dFdxCoarse(s.p_world_mm), down_mm = dFdyCoarse(s.p_world_mm);
    bool together = one_light != 0 && dot(right_mm, right_mm) + dot(down_mm, down_mm) < kGatherTogetherMm * kGatherTogetherMm;
    int lane = (int(gl_FragCoord.x) & 1) + 2 * (int(gl_FragCoord.y) & 1);
    int first = together ? lane : 0, stride = together ? 4 : 1;
    vec4 lit = vec4(0.0);  // alpha: of the penumbra alone, whose weights have the mean 1
    vec3 all = vec3(0.0);
    for (int i = first; i < kShadowGatherTaps; i += stride) {
        if (i - first == kShadowFirstTaps) {
            // Red reaches farthest, so its weight is never 0.
            if (any_of_quad(abs(lit.r - visibility * all.r)) == 0.0) return vec3(visibility);
        }
        vec4 weight = texelFetch(sampler2D(skin_rows, nearest_clamp), ivec2(i, kRowTapWeights), 0);
        vec3 d_mm = texelFetch(sampler2D(skin_rows, nearest_clamp), ivec2(i, kRowTapPlaces), 0).xyz;  // z: the lift
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
