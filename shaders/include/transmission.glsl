// Light that enters the skin elsewhere and leaves here, gathered from the shadow maps (Dachsbacher and Stamminger 2003,
// "Translucent Shadow Maps"): every texel holds a lit point of the skin, and whatever way that faces, the light it takes in
// is what falls on the texel's own area. So int E R(|x - y|) dA over the lit side is a sum over texels without normals.
//
// The light that leaves at x is that integral over the one of R alone, which is 1 on flat skin and more where there is
// skin behind x too: how much more is summed over the lit points off its tangent plane.
//
// The includer says which lit points its own blur or model has left out, so that no light is counted twice:
//
//     float part_not_counted(Surface s, LitPoint lit);
#ifndef DERMIS_TRANSMISSION_GLSL
#define DERMIS_TRANSMISSION_GLSL

#include "shaders/include/lights.glsl"
#include "shaders/include/pixel_turn.glsl"
#include "shaders/include/shadow.glsl"
#include "shaders/include/surface.glsl"
#include "shaders/include/skin/table.glsl"

layout(constant_id = 31) const int transmission = kTransmissionNone;

// R per mm^2 over its integral, and in alpha the reach in mm. With DERMIS_TRANSMISSION_EXPRESSION the includer defines it.
vec4 transmission_row(float distance_over_reach);

const int kTransmissionTaps = 48;
const float kWidestRing = 0.7;  // of the reach
// Profiles that reach farther than the table would end at an edge.
const float kFadeStart = 0.7;
// Of the reach. Dark skin with less before it is at the terminator, or the back of a mesh that is open.
const float kThinnest = 0.004;
// Where a surface takes in more of the light than this, what comes through the skin is not added.
const float kDark = 0.3;

// The light's shadow map around the point that is shaded.
struct LightMap {
    int index;
    vec3 to_light_world, x_world, y_world;
    vec3 here;            // the point in the map
    vec2 axis_x, axis_y;  // a millimetre along x_world and y_world in the map
    float mm_per_z;
};

// Cosine to the normal from which on a lit point is of another wall.
const float kOtherWall = 0.5;

struct LitPoint {
    vec3 p_world_mm;
    vec2 map_uv;
    LightMap map;
};

float part_not_counted(Surface s, LitPoint lit);

LightMap light_map_around(int light, vec3 p_mm, vec3 to_light_world) {
    vec3 up = abs(to_light_world.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    mat4 light_from_world = lights[light].light_view_projection;
    LightMap map;
    map.index = lights[light].shadow_map_index;
    map.to_light_world = to_light_world;
    map.x_world = normalize(cross(up, to_light_world));
    map.y_world = cross(to_light_world, map.x_world);
    map.here = shadow_map_position(light_from_world, p_mm);
    map.axis_x = shadow_map_position(light_from_world, p_mm + map.x_world).xy - map.here.xy;
    map.axis_y = shadow_map_position(light_from_world, p_mm + map.y_world).xy - map.here.xy;
    map.mm_per_z = 1.0 / (map.here.z - shadow_map_position(light_from_world, p_mm + to_light_world).z);
    return map;
}

float lit_z(int map_index, vec2 map_uv) {
    if (map_index == 0) return textureLod(sampler2D(shadow_map, nearest_clamp), map_uv, 0.0).r;
    if (map_index == 1) return textureLod(sampler2D(shadow_map_1, nearest_clamp), map_uv, 0.0).r;
    return textureLod(sampler2D(shadow_map_2, nearest_clamp), map_uv, 0.0).r;
}

// From the depths of the four texels around it.
vec3 lit_normal_world(LitPoint lit) {
    vec4 z;  // below left, below right, above right, above left
    vec2 size;
    if (lit.map.index == 0) {
        z = textureGather(sampler2D(shadow_map, nearest_clamp), lit.map_uv);
        size = vec2(textureSize(sampler2D(shadow_map, nearest_clamp), 0));
    } else if (lit.map.index == 1) {
        z = textureGather(sampler2D(shadow_map_1, nearest_clamp), lit.map_uv);
        size = vec2(textureSize(sampler2D(shadow_map_1, nearest_clamp), 0));
    } else {
        z = textureGather(sampler2D(shadow_map_2, nearest_clamp), lit.map_uv);
        size = vec2(textureSize(sampler2D(shadow_map_2, nearest_clamp), 0));
    }
    vec2 slope = 0.5 * lit.map.mm_per_z * size * vec2(z.y - z.x + z.z - z.w, z.x - z.w + z.y - z.z);
    return normalize(lit.map.to_light_world + dot(slope, lit.map.axis_x) * lit.map.x_world +
                     dot(slope, lit.map.axis_y) * lit.map.y_world);
}

// 0 where the lit point faces as the point that it shines on does, 1 where it faces the other way, as an opposite wall.
float turned_away(Surface s, LitPoint lit) { return 0.5 - 0.5 * dot(s.n_geometry_world, lit_normal_world(lit)); }

#ifndef DERMIS_TRANSMISSION_EXPRESSION
uniform texture2D skin_transmission;  // distance from 0 to the reach

vec4 transmission_row(float distance_over_reach) {
    float size = float(textureSize(sampler2D(skin_transmission, linear_clamp), 0).x);
    return textureLod(sampler2D(skin_transmission, linear_clamp), vec2(texel_centres(distance_over_reach, size), 0.5), 0.0);
}
#endif

// Taps are in rings at even steps of radius, which is closer than even cover where R is large; each counts for its ring's
// area, and they are turned from pixel to pixel: noise instead of bands. What of it lies off the tangent plane adds to the integral of R.
vec3 gathered_light(Surface s, LightMap map, float reach_mm) {
    float step_mm = kWidestRing * reach_mm / float(kTransmissionTaps);
    float turn = pixel_turn(gl_FragCoord.xy);
    vec3 light = vec3(0.0), behind = vec3(0.0);
    for (int i = 0; i < kTransmissionTaps; ++i) {
        float radius_mm = (float(i) + 0.5) * step_mm, angle = turn + float(i) * kGoldenAngle;
        vec2 across_mm = radius_mm * vec2(cos(angle), sin(angle));
        LitPoint lit;
        lit.map = map;
        lit.map_uv = map.here.xy + across_mm.x * map.axis_x + across_mm.y * map.axis_y;
        float z = lit_z(map.index, lit.map_uv);
        if (z == 1.0) continue;  // no skin
        vec3 offset_mm = across_mm.x * map.x_world + across_mm.y * map.y_world +
                         (map.here.z - z) * map.mm_per_z * map.to_light_world;
        float distance_mm = length(offset_mm);
        lit.p_world_mm = s.p_world_mm + offset_mm;
        vec3 r = radius_mm * transmission_row(distance_mm / reach_mm).rgb * part_not_counted(s, lit);
        light += r;
        behind += r * smoothstep(0.0, kOtherWall, abs(dot(s.n_geometry_world, offset_mm)) / max(distance_mm, 1e-6));
    }
    float ring = 2.0 * kPi * step_mm;
    // In a crease, between lips or lids, there is more skin around a point than flat skin has. It is unlit, so that the
    // taps do not find it: the occlusion says how much.
    return s.occlusion * light * ring / (1.0 + behind * ring);
}

// Of the light's way through the body that the includer's own model takes the skin for: past the first nothing is gathered.
const float kOwnBody = 0.9, kOtherBody = 0.5;

// Exitance over albedo. own_way_mm is the light's way through the body that the includer's own model has light through, as
// far as the light is visible; below 0 for none. Where no lit skin is near along the light, as on most of a head's dark side, one tap is all.
vec3 transmitted_exitance(Surface s, int light, LightSample arriving, float n_dot_l, float visibility, float own_way_mm) {
    float lit = max(n_dot_l, 0.0) * visibility;
    if (transmission == kTransmissionNone || lit > kDark || lights[light].shadow_map_index < 0)
        return vec3(0.0);
    LightMap map = light_map_around(light, s.p_world_mm, arriving.to_light_world);
    if (outside_shadow_map(map.here)) return vec3(0.0);
    float reach_mm = transmission_row(0.0).a;
    float depth_mm = (map.here.z - lit_z(map.index, map.here.xy)) * map.mm_per_z;
    float part = smoothstep(kThinnest * reach_mm, 4.0 * kThinnest * reach_mm, depth_mm) *
                 (1.0 - smoothstep(kFadeStart * reach_mm, reach_mm, depth_mm)) * (1.0 - smoothstep(0.0, kDark, lit));
    if (own_way_mm >= 0.0) {
        float own = (depth_mm - kOtherBody * own_way_mm) / max((kOwnBody - kOtherBody) * own_way_mm, 1e-4);
        part *= 1.0 - visibility * clamp(own, 0.0, 1.0);
    }
    if (part == 0.0) return vec3(0.0);
    return part * arriving.irradiance_linear * gathered_light(s, map, reach_mm);
}

#endif
