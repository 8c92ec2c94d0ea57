// Visibility of a light: percentage-closer filtering over a disk of a width in mm, and the tint of translucent surfaces.
#ifndef DERMIS_SHADOW_GLSL
#define DERMIS_SHADOW_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "shaders/include/frame.glsl"
#include "shaders/include/lights.glsl"

// Of the key light, then of the others that cast shadows: depth of opaque surfaces, and optical depth (minus the logarithm
// of the transmittance) of the translucent ones before them.
uniform texture2D shadow_map, shadow_map_1, shadow_map_2;
uniform texture2D shadow_tint, shadow_tint_1, shadow_tint_2;

layout(constant_id = 30) const int tinted_shadows = 0;
// With 1, no code for other maps is compiled: a software device executes every branch.
layout(constant_id = 32) const int shadow_map_count = kMaxShadowMaps;

// Given by the device.
layout(constant_id = 34) const int on_cpu = 0;

const int kTintTaps = 12;

// Point `index` of a Vogel spiral: even cover of the unit disk by any number of points (Vogel 1979).
vec2 vogel_disk(int index, int count) {
    float radius = sqrt((float(index) + 0.5) / float(count));
    float angle = float(index) * kGoldenAngle;
    return radius * vec2(cos(angle), sin(angle));
}

// No depth is below 0, so both ends may be clamped, which is free on a GPU.
float shadow_depth_tap(texture2D map, vec3 p_light) {
    float z = on_cpu != 0 ? min(p_light.z, 1.0) : clamp(p_light.z, 0.0, 1.0);
    return textureLod(sampler2DShadow(map, shadow_compare), vec3(p_light.xy, z), 0.0);
}

// In the shadow map of a light, by LightSource::shadow_map_index.
float shadow_depth_tap(int map_index, vec3 p_light) {
    if (shadow_map_count == 1 || map_index == 0) return shadow_depth_tap(shadow_map, p_light);
    if (map_index == 1) return shadow_depth_tap(shadow_map_1, p_light);
    return shadow_depth_tap(shadow_map_2, p_light);
}

vec3 shadow_map_position(mat4 light_from_world, vec3 p_mm) {
    vec4 p = light_from_world * vec4(p_mm, 1.0);
    if (all_directional != 0) return vec3(p.xy * 0.5 + 0.5, p.z);
    return p.w > 0.0 ? vec3(p.xy / p.w * 0.5 + 0.5, p.z / p.w) : vec3(-1.0);  // behind a spot or point light
}

// Offset in the map from origin_mm to a point beside it.
vec3 shadow_map_step(mat4 light_from_world, vec3 origin_mm, vec3 origin_in_map, vec3 step_mm) {
    if (all_directional != 0) return (light_from_world * vec4(step_mm, 0.0)).xyz * vec3(0.5, 0.5, 1.0);
    return shadow_map_position(light_from_world, origin_mm + step_mm) - origin_in_map;
}

// A point beyond the far end of the map counts as inside: everything still lies between it and the light.
bool outside_shadow_map(vec3 p_light) {
    return any(lessThan(p_light, vec3(0.0))) || any(greaterThan(p_light.xy, vec2(1.0)));
}

// The disk of a filtered shadow lies in the tangent plane of the receiver and is round as seen from the light, so flat and
// convex surfaces do not shadow themselves, and shadows do not move as the filter grows. At grazing light, where the disk
// would be endless, the lookup is lifted by the filter's radius instead (Holbert 2011). In cavities with a radius above ten
// times the disk's, the disk is lifted too. dermis/reference/lighting.cpp has the same disk.
struct ShadowDisk {
    vec3 center, axis_x, axis_y;  // in the shadow map
    vec3 lift;                    // a millimetre along the normal, in the shadow map
    vec3 concavity_mm;            // lift of x^2, y^2, xy
};

// The part of the disk that does not depend on the light's map.
struct DiskPlane {
    vec2 slope;    // of the way towards the light over the way across it
    float lift_mm;
    vec3 concavity_mm;
};

// n_in_light: the normal along two axes across the light and towards it.
DiskPlane disk_plane(vec3 n_in_light, float radius_mm) {
    float n_dot_l = clamp(n_in_light.z, 0.0, 1.0), sine = sqrt(1.0 - n_dot_l * n_dot_l);
    // `lacking`: how far the limited slope leaves the disk below the surface.
    float lacking = max(0.0, sine - kShadowMaxSlope * n_dot_l);
    DiskPlane plane;
    plane.slope = -n_in_light.xy * min(1.0 / max(n_dot_l, 1e-3), kShadowMaxSlope / max(sine, 1e-3));
    plane.lift_mm = max(1.5 * shadow_texel_mm, kShadowFacetLift * radius_mm) + lacking * min(radius_mm, 0.5 * penumbra_mm);
    vec2 s = plane.slope;
    plane.concavity_mm = 0.5 * kShadowConcavity * radius_mm * vec3(1.0 + s * s, 2.0 * s.x * s.y);
    return plane;
}

ShadowDisk shadow_disk(mat4 light_from_world, vec3 p_mm, vec3 n_world, vec3 to_light_world, float radius_mm) {
    vec3 up = abs(to_light_world.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 x = normalize(cross(up, to_light_world)), y = cross(to_light_world, x);
    DiskPlane plane = disk_plane(vec3(dot(x, n_world), dot(y, n_world), dot(to_light_world, n_world)), radius_mm);
    ShadowDisk disk;
    vec3 origin_mm = p_mm + plane.lift_mm * n_world;
    disk.center = shadow_map_position(light_from_world, origin_mm);
    disk.axis_x = shadow_map_step(light_from_world, origin_mm, disk.center, radius_mm * (x + plane.slope.x * to_light_world));
    disk.axis_y = shadow_map_step(light_from_world, origin_mm, disk.center, radius_mm * (y + plane.slope.y * to_light_world));
    disk.lift = shadow_map_step(light_from_world, origin_mm, disk.center, n_world);
    disk.concavity_mm = plane.concavity_mm;
    return disk;
}

// The same along the map's own axes, where all lights are directional.
ShadowDisk shadow_disk(LightSource source, vec3 p_mm, vec3 n_world, float radius_mm) {
    vec3 n = vec3(dot(source.x_world, n_world), dot(source.y_world, n_world), dot(source.to_light_world, n_world));
    DiskPlane plane = disk_plane(n, radius_mm);
    float map_z_per_mm = -1.0 / source.mm_per_map_z;
    ShadowDisk disk;
    disk.lift = n * vec3(vec2(source.map_per_mm), map_z_per_mm);
    disk.center = shadow_map_position(source.light_view_projection, p_mm) + plane.lift_mm * disk.lift;
    disk.axis_x = radius_mm * vec3(source.map_per_mm, 0.0, plane.slope.x * map_z_per_mm);
    disk.axis_y = radius_mm * vec3(0.0, source.map_per_mm, plane.slope.y * map_z_per_mm);
    disk.concavity_mm = plane.concavity_mm;
    return disk;
}

// Where tap v of the unit disk reads.
vec3 shadow_tap_position(ShadowDisk disk, vec2 v) {
    float lift_mm = dot(disk.concavity_mm, vec3(v * v, v.x * v.y));
    return disk.center + v.x * disk.axis_x + v.y * disk.axis_y + lift_mm * disk.lift;
}

float filter_radius_mm(float width_mm) { return max(0.5 * width_mm, shadow_texel_mm); }

// If the outermost taps, which surround the disk, agree, the others are not read. This misses an edge that cuts off less of
// the disk than lies between two of them: less than one tap's share.
bool outer_taps_agree(float lit) { return lit == 0.0 || lit == float(kShadowOuterTaps); }

float taps_lit(texture2D map, ShadowDisk disk, int first, int end) {
    float lit = 0.0;
    for (int i = first; i < end; ++i)
        lit += shadow_depth_tap(map, shadow_tap_position(disk, vogel_disk(i, kShadowTaps)));
    return lit;
}

// The same for a software device, which executes both sides of a branch but can leave a loop early: all taps are read in a
// loop, one per iteration, from the last to the first. The outermost taps read the nearest texel alone, because a filtered
// tap costs four reads.
float disk_visibility_on_cpu(texture2D map, ShadowDisk disk) {
    float nearest = 0.0;
    for (int i = kShadowTaps - kShadowOuterTaps; i < kShadowTaps; ++i) {
        vec3 p = shadow_tap_position(disk, vogel_disk(i, kShadowTaps));
        nearest += float(min(p.z, 1.0) <= textureLod(sampler2D(map, nearest_clamp), p.xy, 0.0).r);
    }
    const float kLastAngle = float(kShadowTaps - 1) * kGoldenAngle;
    const float kCos = cos(kGoldenAngle), kSin = sin(kGoldenAngle);
    vec2 direction = vec2(cos(kLastAngle), sin(kLastAngle));
    float lit = 0.0;
    int count = outer_taps_agree(nearest) ? 0 : kShadowTaps;
    [[dont_unroll]] for (int i = 0; i < count; ++i) {
        float radius = sqrt((float(kShadowTaps - 1 - i) + 0.5) / float(kShadowTaps));
        lit += shadow_depth_tap(map, shadow_tap_position(disk, radius * direction));
        direction = vec2(kCos * direction.x + kSin * direction.y, kCos * direction.y - kSin * direction.x);
    }
    return count == 0 ? nearest / float(kShadowOuterTaps) : lit / float(kShadowTaps);
}

float disk_visibility(texture2D map, ShadowDisk disk) {
    if (on_cpu != 0) return disk_visibility_on_cpu(map, disk);
    float outer = taps_lit(map, disk, kShadowTaps - kShadowOuterTaps, kShadowTaps);
    if (outer_taps_agree(outer)) return outer / float(kShadowOuterTaps);
    return (outer + taps_lit(map, disk, 0, kShadowTaps - kShadowOuterTaps)) / float(kShadowTaps);
}

vec3 disk_tint(texture2D map, ShadowDisk disk) {
    vec3 tint = vec3(0.0);
    for (int i = 0; i < kTintTaps; ++i)
        tint += exp(-textureLod(sampler2D(map, trilinear_clamp), shadow_tap_position(disk, vogel_disk(i, kTintTaps)).xy, 0.0).rgb);
    return tint / float(kTintTaps);
}

// Visibility of the key light: 0 in shadow, 1 lit and outside the map.
float shadow_visibility(vec3 p_world_mm, vec3 n_geometry_world, vec3 to_light_world, float width_mm) {
    ShadowDisk disk =
        shadow_disk(light_view_projection, p_world_mm, n_geometry_world, to_light_world, filter_radius_mm(width_mm));
    return outside_shadow_map(disk.center) ? 1.0 : disk_visibility(shadow_map, disk);
}

struct LightThrough {
    float visibility;  // past opaque surfaces
    vec3 tint;         // of the translucent ones
};

LightThrough disk_through(texture2D map, texture2D tint_map, ShadowDisk disk) {
    float visibility = disk_visibility(map, disk);
    if (tinted_shadows == 0 || visibility == 0.0) return LightThrough(visibility, vec3(1.0));
    return LightThrough(visibility, disk_tint(tint_map, disk));
}

// The one rule for skin, eyes, frames and glass; dermis/reference/lighting.cpp has the same by rays.
LightThrough light_through(int light, vec3 p_world_mm, vec3 n_geometry_world, vec3 to_light_world, float width_mm) {
    LightSource source = light_source(light);
    int index = source.shadow_map_index;
    if (index < 0) return LightThrough(1.0, vec3(1.0));
    float radius_mm = filter_radius_mm(width_mm);
    ShadowDisk disk;
    if (all_directional != 0)
        disk = shadow_disk(source, p_world_mm, n_geometry_world, radius_mm);
    else
        disk = shadow_disk(source.light_view_projection, p_world_mm, n_geometry_world, to_light_world, radius_mm);
    if (outside_shadow_map(disk.center)) return LightThrough(1.0, vec3(1.0));
    if (shadow_map_count == 1 || index == 0) return disk_through(shadow_map, shadow_tint, disk);
    if (index == 1) return disk_through(shadow_map_1, shadow_tint_1, disk);
    return disk_through(shadow_map_2, shadow_tint_2, disk);
}

#endif
