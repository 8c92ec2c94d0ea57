// Light that enters the skin elsewhere and leaves here, gathered from the shadow maps (Dachsbacher and Stamminger 2003,
// "Translucent Shadow Maps"). Every texel holds a lit point of the skin, and the light that enters there is the light that
// falls on the texel's area. So int E R(|x - y|) dA over the lit side is a sum over texels without normals.
//
// The light that leaves at x is that integral divided by the integral of R alone. The latter is 1 on flat skin and larger
// where skin lies behind x; the excess is summed over the lit points off the tangent plane.
//
// Only texels that hold skin count: frames and eyes in front of the skin shade it.
//
// The includer defines which lit points its own blur or model leaves out, so that no light is counted twice:
//
//     float part_not_counted(LightMap map, LitPoint lit);
#ifndef DERMIS_TRANSMISSION_GLSL
#define DERMIS_TRANSMISSION_GLSL

#include "shaders/include/lights.glsl"
#include "shaders/include/pixel_turn.glsl"
#include "shaders/include/shadow.glsl"
#include "shaders/include/surface.glsl"
#include "shaders/include/skin/table.glsl"

layout(constant_id = 31) const int transmission = kTransmissionNone;

// The shadow maps' texels that hold skin, 1 in the others; the shadow maps themselves where all of the scene is skin.
uniform texture2D lit_skin, lit_skin_1, lit_skin_2;

// R per mm^2 over its integral, at a part of the reach. With DERMIS_TRANSMISSION_EXPRESSION the includer defines both.
vec3 transmission_profile(float distance_over_reach);
float transmission_reach();

// Taps of a quad of 2 x 2 pixels: each pixel that is drawn takes its part, and all get the sum.
const int kTransmissionTaps = 64;
// Pixels farther apart than this fraction of the reach do not share taps; each takes half of them.
const float kSharedStep = 0.1;
const float kWidestRing = 0.7;  // of the reach
// Profiles that reach farther than the table would end at an edge.
const float kFadeStart = 0.7;
// The least thickness, over the reach. A thinner dark point is at the terminator, or on the back of an open mesh.
const float kThinnest = 0.004;
// Texels from the middle of one to the farthest point that reads it, and the steepest slope that this is done for. Past
// the terminator there is skin before the point, unless the mesh is open there: the slope counts less.
const float kTexelRise = 0.7, kSteepest = 12.0, kSlopesAway = 4.0;
// A surface that receives more of the light than this gets no transmission.
const float kDark = 0.3;

// The light's shadow map around the point that is shaded.
struct LightMap {
    int index;
    float reach_mm;
    vec3 to_light_world, x_world, y_world;
    vec3 n_in_light;      // the point's geometric normal along x_world, y_world and to_light_world
    vec3 here;            // the point in the map: texture coordinates and depth
    vec2 axis_x, axis_y;  // a millimetre along x_world and y_world, in texture coordinates
    float mm_per_z;       // towards the light
    bool valid;  // false behind a light, and beside the triangle where a driver loads nothing for such pixels
};

// A lit point whose normal has a smaller cosine than this belongs to another wall.
const float kOtherWall = 0.5;
// Ignore normals of lit points that face the light less: they are differences of depth across a silhouette.
const float kLeastFacing = 0.03;

// Along x_world, y_world and to_light_world of the light's map.
struct LitPoint {
    vec3 offset_mm;  // from the point that is shaded
    vec3 n;
    float cosine;    // of n to the normal of the point that is shaded
};

float part_not_counted(LightMap map, LitPoint lit);

vec3 along_axes(LightMap map, vec3 v_world) {
    return vec3(dot(v_world, map.x_world), dot(v_world, map.y_world), dot(v_world, map.to_light_world));
}

vec3 to_world(LightMap map, vec3 v) { return v.x * map.x_world + v.y * map.y_world + v.z * map.to_light_world; }

// A millimetre along `axis_world` from the point whose place in the map is `here`, by the map's derivative.
vec3 in_light_map(mat4 light_from_world, vec4 here_clip, vec3 axis_world) {
    vec4 d = light_from_world * vec4(axis_world, 0.0);
    return (d.xyz - here_clip.xyz * (d.w / here_clip.w)) / here_clip.w * vec3(0.5, 0.5, 1.0);
}

LightMap light_map_around(int light, vec3 p_mm, vec3 n_geometry_world, vec3 to_light_world, float reach_mm) {
    LightSource source = light_source(light);
    mat4 light_from_world = source.light_view_projection;
    LightMap map;
    map.index = source.shadow_map_index;
    map.reach_mm = reach_mm;
    map.to_light_world = to_light_world;
    vec4 here_clip = light_from_world * vec4(p_mm, 1.0);
    // Helper invocations load uniform blocks, but not storage buffers on every driver.
    map.valid = (all_directional != 0 && one_light != 0) || here_clip.w > 0.0;
    if (all_directional != 0) {
        map.x_world = source.x_world;
        map.y_world = source.y_world;
        map.axis_x = vec2(source.map_per_mm, 0.0);
        map.axis_y = vec2(0.0, source.map_per_mm);
        map.mm_per_z = source.mm_per_map_z;
        map.here = here_clip.xyz;
    } else {
        vec3 up = abs(to_light_world.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
        map.x_world = normalize(cross(up, to_light_world));
        map.y_world = cross(to_light_world, map.x_world);
        if (!map.valid) here_clip = vec4(0.0, 0.0, 0.0, 1.0);
        map.axis_x = in_light_map(light_from_world, here_clip, map.x_world).xy;
        map.axis_y = in_light_map(light_from_world, here_clip, map.y_world).xy;
        map.mm_per_z = -1.0 / in_light_map(light_from_world, here_clip, to_light_world).z;
        map.here = here_clip.xyz / here_clip.w;
    }
    map.here = map.here * vec3(0.5, 0.5, 1.0) + vec3(0.5, 0.5, 0.0);
    map.n_in_light = along_axes(map, n_geometry_world);
    return map;
}

float shadow_z(int map_index, vec2 map_uv) {
    if (shadow_map_count == 1 || map_index == 0) return textureLod(sampler2D(shadow_map, nearest_clamp), map_uv, 0.0).r;
    if (map_index == 1) return textureLod(sampler2D(shadow_map_1, nearest_clamp), map_uv, 0.0).r;
    return textureLod(sampler2D(shadow_map_2, nearest_clamp), map_uv, 0.0).r;
}

// Depths of the four texels around: below left, below right, above right, above left; 1 without lit skin.
vec4 lit_skin_z4(int map_index, vec2 map_uv) {
    if (shadow_map_count == 1 || map_index == 0) return textureGather(sampler2D(lit_skin, nearest_clamp), map_uv);
    if (map_index == 1) return textureGather(sampler2D(lit_skin_1, nearest_clamp), map_uv);
    return textureGather(sampler2D(lit_skin_2, nearest_clamp), map_uv);
}

// The depth of the nearest of the four, without reading it again.
float nearest_of(vec2 place_texels, vec4 z) {
    vec2 f = fract(place_texels - 0.5);
    return f.x < 0.5 ? (f.y < 0.5 ? z.w : z.x) : (f.y < 0.5 ? z.z : z.y);
}

// The normal of lit skin by differences of depth along the diagonals of the four texels around it: with a = z.y - z.w and
// b = z.z - z.x it is along (a tilt_a + b tilt_b, 1). All but a and b is the same for all taps.
struct LitNormals {
    vec2 tilt_a, tilt_b;
    vec3 onto_here;  // of a, b and 1 along the normal of the point that is shaded
};

LitNormals lit_normals(LightMap map) {
    float scale = 0.5 * shadow_map_texels * map.mm_per_z;
    vec2 x = scale * map.axis_x, y = scale * map.axis_y, tilt_a = vec2(x.x + x.y, y.x + y.y), tilt_b = vec2(x.x - x.y, y.x - y.y);
    vec3 here = map.n_in_light;
    return LitNormals(tilt_a, tilt_b, vec3(dot(tilt_a, here.xy), dot(tilt_b, here.xy), here.z));
}

LitPoint lit_point(LitNormals normals, vec3 offset_mm, vec4 z) {
    float a = z.y - z.w, b = z.z - z.x;
    vec2 tilt = a * normals.tilt_a + b * normals.tilt_b;
    float per_length = inversesqrt(dot(tilt, tilt) + 1.0);
    float cosine = (a * normals.onto_here.x + b * normals.onto_here.y + normals.onto_here.z) * per_length;
    return LitPoint(offset_mm, vec3(tilt, 1.0) * per_length, cosine);
}

// 0 where the lit point faces like the shaded point, 1 where it faces the other way, as an opposite wall does.
float turned_away(LitPoint lit) { return 0.5 - 0.5 * lit.cosine; }

#ifndef DERMIS_TRANSMISSION_EXPRESSION
uniform texture2D skin_transmission;  // distance from 0 to the reach, read without interpolation; the reach in alpha

vec4 transmission_texel(float distance_over_reach) {
    float u = distance_over_reach * (1.0 - 1.0 / float(kTransmissionTexels)) + 0.5 / float(kTransmissionTexels);
    return textureLod(sampler2D(skin_transmission, nearest_clamp), vec2(u, 0.5), 0.0);
}
vec3 transmission_profile(float distance_over_reach) { return transmission_texel(distance_over_reach).rgb; }
float transmission_reach() { return transmission_texel(0.0).a; }
#endif

// Sum over the four pixels of a quad, numbered from 0, row by row. All four must come here together.
vec4 sum_of_quad(int lane, vec4 v) {
    vec4 across = dFdxFine(v), pair = 2.0 * v + ((lane & 1) != 0 ? -across : across), down = dFdyFine(pair);
    return 2.0 * pair + ((lane & 2) != 0 ? -down : down);
}

// Above 0 if v is above 0 in any pixel of the quad; v >= 0. All four pixels must call this together.
float any_of_quad(float v) {
    float row = v + abs(dFdxFine(v));
    return row + abs(dFdyFine(row));
}

// Taps lie on rings at even steps of radius, denser where R is large; each counts for its ring's area. The rings turn from
// quad to quad: noise instead of bands. Taps off the tangent plane add to the integral of R.
vec3 gathered_light(LightMap map, bool needed) {
    // One decision for all four pixels of a quad. Helper invocations beside the triangle take none.
    bool together =
        length(dFdxCoarse(p_world_mm_in)) + length(dFdyCoarse(p_world_mm_in)) < 2.0 * kSharedStep * map.reach_mm;
    ivec2 in_quad = ivec2(gl_FragCoord.xy) & 1;
    int lane = in_quad.x + 2 * in_quad.y;
    vec4 drawn = vec4(equal(ivec4(lane), ivec4(0, 1, 2, 3))) * float(map.valid);
    bool any_needs = any_of_quad(float(needed && map.valid)) > 0.0;
    drawn = sum_of_quad(lane, drawn);
    float stride = together ? dot(drawn, vec4(1.0)) : 2.0;
    float first = together ? dot(drawn, vec4(lessThan(ivec4(0, 1, 2, 3), ivec4(lane)))) : 0.0;
    float turn = pixel_turn(together ? floor(0.5 * gl_FragCoord.xy) : gl_FragCoord.xy) + first * kGoldenAngle;
    float step_angle = stride * kGoldenAngle;
    vec2 direction = vec2(cos(turn), sin(turn)), step = vec2(cos(step_angle), sin(step_angle));
    float ring_mm = map.reach_mm * kWidestRing / float(kTransmissionTaps), per_reach = 1.0 / map.reach_mm;
    LitNormals normals = lit_normals(map);
    float radius_mm = (first + 0.5) * ring_mm, step_mm = stride * ring_mm, end_mm = float(kTransmissionTaps) * ring_mm;
    vec3 light = vec3(0.0), behind = vec3(0.0);
    if (any_needs && map.valid) {
        for (; radius_mm < end_mm; radius_mm += step_mm) {
            vec2 across_mm = radius_mm * direction;
            direction = vec2(direction.x * step.x - direction.y * step.y, direction.x * step.y + direction.y * step.x);
            vec2 place = map.here.xy + across_mm.x * map.axis_x + across_mm.y * map.axis_y;
            vec4 z4 = lit_skin_z4(map.index, place);
            float z = nearest_of(place * shadow_map_texels, z4);
            vec3 offset_mm = vec3(across_mm, (map.here.z - z) * map.mm_per_z);
            float way2_mm2 = dot(offset_mm, offset_mm), per_way = inversesqrt(way2_mm2);
            LitPoint lit = lit_point(normals, offset_mm, z4);
            bool usable = z < 1.0 && lit.n.z > kLeastFacing;  // 1: no lit skin
            float weight = usable ? radius_mm * part_not_counted(map, lit) : 0.0;
            vec3 profile = transmission_profile(way2_mm2 * per_way * per_reach);
            light += weight * profile;
            behind += weight * smoothstep(0.0, kOtherWall, abs(dot(map.n_in_light, offset_mm)) * per_way) * profile;
        }
    }
    float per_tap_mm = 2.0 * kPi * ring_mm * (together ? 1.0 : stride);
    if (together) {
        light = sum_of_quad(lane, vec4(light, 0.0)).rgb;
        behind = sum_of_quad(lane, vec4(behind, 0.0)).rgb;
    }
    return light * per_tap_mm / (1.0 + behind * per_tap_mm);
}

// Of the light's way through the body that the includer's own model takes the skin for: past the first nothing is
// gathered.
const float kOwnBody = 0.9, kOtherBody = 0.5;

// Exitance over albedo, over the light's irradiance and over Surface::occlusion, by which the includer multiplies: creases
// hold unlit skin that the taps do not find. Only load_geometry() must have run. own_way_mm: length of the light's way
// through the body in the includer's own model, scaled by the light's visibility; below 0 for none. Without lit skin near
// along the light, one tap is taken.
vec3 transmitted_part(Surface s, int light, vec3 to_light_world, float n_dot_l, float visibility, float own_way_mm) {
    if (transmission == kTransmissionNone) return vec3(0.0);
    float lit = max(n_dot_l, 0.0) * visibility;
    float reach_mm = transmission_reach();
    LightMap map = light_map_around(light, s.p_world_mm, s.n_geometry_world, to_light_world, reach_mm);
    float depth_mm = (map.here.z - shadow_z(map.index, map.here.xy)) * map.mm_per_z;
    // The map's texel may be of the point's own surface: where that slopes, nearer to the light by its rise.
    float cosine = dot(s.n_geometry_world, to_light_world);
    float slope = sqrt(max(1.0 - cosine * cosine, 0.0)) / max(max(cosine, -kSlopesAway * cosine), 1e-3);
    float rise_mm = kTexelRise * shadow_texel_mm * min(slope, kSteepest);
    float part = smoothstep(kThinnest * reach_mm, 4.0 * kThinnest * reach_mm, depth_mm - rise_mm) *
                 (1.0 - smoothstep(kFadeStart * reach_mm, reach_mm, depth_mm)) * (1.0 - smoothstep(0.0, kDark, lit));
    if (own_way_mm >= 0.0) {
        float own = (depth_mm - kOtherBody * own_way_mm) / max((kOwnBody - kOtherBody) * own_way_mm, 1e-4);
        part *= 1.0 - visibility * clamp(own, 0.0, 1.0);
    }
    if (!map.valid || map.index < 0 || outside_shadow_map(map.here)) part = 0.0;
    // No return before it: it is for all pixels of a quad, or none.
    return part * gathered_light(map, part > 0.0);
}

#endif
