// shadow=gathered: the places of shaders/include/skin/gathered_shadow.glsl, read from the shadow map.
#ifndef DERMIS_GATHERED_SHADOW_GLSL
#define DERMIS_GATHERED_SHADOW_GLSL

#include "shaders/include/transmission.glsl"
#include "shaders/include/skin/gathered_shadow.glsl"
#include "techniques/preintegrated/tables.glsl"

// Pixels whose diagonal is shorter share their taps.
const float kGatherTogetherMm = 0.7;

// The surface around the point: tangent x towards the light, tangent y across.
struct Quadric {
    vec3 n, x, y;       // world
    vec2 cosine_sine;   // of the angle between the light and n
    vec3 bends_per_mm;  // gather_bends()
};

Quadric quadric_around(Surface s, vec3 to_light_world, vec3 across_light_world) {
    Quadric q;
    q.n = s.n_geometry_world;
    float cosine = dot(q.n, to_light_world);
    q.cosine_sine = vec2(cosine, length(to_light_world - cosine * q.n));
    q.x = gather_tangent(q.n, to_light_world, across_light_world);
    q.y = cross(q.n, q.x);
    q.bends_per_mm = gather_bends(s.curvature_diagonal_per_mm, s.curvature_mixed_per_mm, q.x, q.y);
    return q;
}

// All four pixels of a quad must call this together. Where they are near each other, each takes a quarter of the taps. The
// farthest taps come first: if these and the filtered shadow agree that all or nothing is lit, the rest is skipped.
Entering gathered_visibility(Surface s, int light, vec3 to_light_world, float visibility) {
    Entering plain = Entering(vec3(visibility), vec3(visibility));
    LightSource source = light_source(light);
    vec3 up = abs(to_light_world.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 across_light_world = all_directional != 0 ? source.x_world : normalize(cross(up, to_light_world));
    Quadric q = quadric_around(s, to_light_world, across_light_world);
    vec3 here = shadow_map_position(source.light_view_projection, s.p_world_mm);
    vec3 step_x = shadow_map_step(source.light_view_projection, s.p_world_mm, here, q.x);
    vec3 step_y = shadow_map_step(source.light_view_projection, s.p_world_mm, here, q.y);
    if (all_directional != 0) step_y.z = 0.0;  // across the light
    vec3 step_n = shadow_map_step(source.light_view_projection, s.p_world_mm, here, q.n);
    here += gather_lift_mm(shadow_texel_mm) * step_n;
    // Helper pixels beside the triangle may not load storage buffers.
    vec3 right_mm = dFdxCoarse(s.p_world_mm), down_mm = dFdyCoarse(s.p_world_mm);
    bool together = one_light != 0 && dot(right_mm, right_mm) + dot(down_mm, down_mm) < kGatherTogetherMm * kGatherTogetherMm;
    int lane = (int(gl_FragCoord.x) & 1) + 2 * (int(gl_FragCoord.y) & 1);
    int first = together ? lane : 0, stride = together ? 4 : 1;
    vec4 lit = vec4(0.0);  // alpha: lit share of the penumbra, by weights with mean 1
    vec3 all = vec3(0.0);
    vec2 red = vec2(0.0);  // lit and all of the places that are trusted; red's weights are 1
    for (int i = first; i < kShadowGatherTaps; i += stride) {
        if (i - first == kShadowFirstTaps) {
            // Red reaches farthest, so its weight is never 0.
            if (any_of_quad(abs(lit.r - visibility * all.r)) == 0.0) return plain;
        }
        vec4 weight = texelFetch(sampler2D(skin_rows, nearest_clamp), ivec2(i, kRowTapWeights), 0);
        vec3 d_mm = texelFetch(sampler2D(skin_rows, nearest_clamp), ivec2(i, kRowTapPlaces), 0).xyz;  // z: the lift
        float n_dot_l = gather_cosine(d_mm.xy, q.bends_per_mm, q.cosine_sine.x, q.cosine_sine.y);
        float rise_mm = gather_rise_mm(d_mm.xy, d_mm.z, q.bends_per_mm);
        float v = shadow_depth_tap(source.shadow_map_index, here + d_mm.x * step_x + d_mm.y * step_y + rise_mm * step_n);
        all += n_dot_l * weight.rgb;
        lit += vec4(vec3(v * n_dot_l), v) * weight;
        red += gather_trust(d_mm.xy, q.bends_per_mm) * n_dot_l * vec2(v, 1.0);
    }
    if (together) {
        lit = sum_of_quad(lane, lit);
        vec4 sums = sum_of_quad(lane, vec4(all, red.x));
        all = sums.rgb;
        red = vec2(sums.a, sum_of_quad(lane, vec4(red.y)).x);
    }
    if (source.shadow_map_index < 0 || outside_shadow_map(here)) return plain;
    vec3 gathered = gathered_light(visibility, lit.rgb, all, lit.a, float(kShadowGatherTaps));
    vec3 trusted = gathered_trusted_light(visibility, gathered, red, lit.a, float(kShadowGatherTaps));
    return Entering(trusted, gathered_gain_light(visibility, gathered));
}

#endif
