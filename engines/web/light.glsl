// The key light's shadow, and light from the environment.

uniform mediump sampler2DShadow shadow_map;
uniform mat4 light_view_projection;
uniform float shadow_texel_mm, penumbra_mm;
uniform vec3 radiance_sh[9];
uniform float environment_intensity, environment_yaw_rad;
uniform samplerCube environment_cube;
uniform vec2 environment_levels;  // how many, and the first one's number
uniform sampler2D environment_brdf;

vec3 shadow_map_position(vec3 p) {
    vec4 clip = light_view_projection * vec4(p, 1.0);
    return clip.xyz * 0.5 + 0.5;
}

// The disk of a filtered shadow, in the shadow map.
struct ShadowDisk {
    vec3 center, axis_x, axis_y;
    vec3 lift;          // a millimetre along the normal
    vec3 concavity_mm;  // lift of x^2, y^2, xy
};

float taps_lit(ShadowDisk disk, int first, int end) {
    float lit = 0.0;
    for (int i = first; i < end; ++i) {
        float angle = float(i) * kGoldenAngle;
        vec2 v = sqrt((float(i) + 0.5) / float(kShadowTaps)) * vec2(cos(angle), sin(angle));
        vec3 tap = disk.center + v.x * disk.axis_x + v.y * disk.axis_y +
                   dot(disk.concavity_mm, vec3(v * v, v.x * v.y)) * disk.lift;
        lit += texture(shadow_map, vec3(tap.xy, min(tap.z, 1.0)));
    }
    return lit;
}

// Share of a disk, `width_mm` across, that sees the light. The disk lies in the tangent plane, round as the light sees it; at
// grazing light, where it would be endless, the lookup is lifted.
float shadow_visibility(vec3 p, vec3 n, vec3 to_light, float width_mm) {
    float radius_mm = max(0.5 * width_mm, shadow_texel_mm);
    vec3 up = abs(to_light.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 x = normalize(cross(up, to_light)), y = cross(to_light, x);
    float n_dot_l = clamp(dot(n, to_light), 0.0, 1.0), sine = sqrt(1.0 - n_dot_l * n_dot_l);
    vec2 slope = vec2(dot(x, n), dot(y, n)) * min(1.0 / max(n_dot_l, 1e-3), kShadowMaxSlope / max(sine, 1e-3));
    float lacking = max(0.0, sine - kShadowMaxSlope * n_dot_l);
    x = radius_mm * (x - slope.x * to_light);
    y = radius_mm * (y - slope.y * to_light);
    float lift_mm = max(1.5 * shadow_texel_mm, kShadowFacetLift * radius_mm) + lacking * min(radius_mm, 0.5 * penumbra_mm);
    vec3 origin_mm = p + lift_mm * n, center = shadow_map_position(origin_mm);
    ShadowDisk disk = ShadowDisk(center, shadow_map_position(origin_mm + x) - center, shadow_map_position(origin_mm + y) - center,
                                 shadow_map_position(origin_mm + n) - center,
                                 0.5 * kShadowConcavity / radius_mm * vec3(dot(x, x), dot(y, y), 2.0 * dot(x, y)));
    // The outermost taps first: where they agree the others are not read (shaders/include/shadow.glsl).
    float outer = taps_lit(disk, kShadowTaps - kShadowOuterTaps, kShadowTaps);
    if (outer == 0.0 || outer == float(kShadowOuterTaps)) return outer / float(kShadowOuterTaps);
    return (outer + taps_lit(disk, 0, kShadowTaps - kShadowOuterTaps)) / float(kShadowTaps);
}

vec3 to_environment(vec3 d) {
    float c = cos(environment_yaw_rad), s = sin(environment_yaw_rad);
    return vec3(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
}

// Spherical harmonics of order 2, a weight a band (Ramamoorthi, Hanrahan 2001); Lambert's are pi, 2 pi / 3, pi / 4.
vec3 environment_convolved(vec3 normal_world, vec3 band_0, vec3 band_1, vec3 band_2) {
    vec3 n = to_environment(normal_world);
    vec3 l0 = 0.282095 * radiance_sh[0];
    vec3 l1 = 0.488603 * (n.y * radiance_sh[1] + n.z * radiance_sh[2] + n.x * radiance_sh[3]);
    vec3 l2 = 1.092548 * (n.x * n.y * radiance_sh[4] + n.y * n.z * radiance_sh[5] + n.x * n.z * radiance_sh[7]) +
              0.315392 * (3.0 * n.z * n.z - 1.0) * radiance_sh[6] + 0.546274 * (n.x * n.x - n.y * n.y) * radiance_sh[8];
    return max(band_0 * l0 + band_1 * l1 + band_2 * l2, vec3(0.0)) * environment_intensity;
}

// Prefiltered for GGX.
vec3 environment_specular(vec3 n, vec3 to_eye, float roughness, float f0, float occlusion) {
    float n_dot_v = clamp(dot(n, to_eye), 1e-3, 1.0);
    float level = roughness * (environment_levels.x - 1.0) - environment_levels.y;
    vec3 radiance = textureLod(environment_cube, to_environment(reflect(-to_eye, n)), max(level, 0.0)).rgb;
    vec2 brdf = textureLod(environment_brdf, vec2(n_dot_v, roughness), 0.0).rg;
    return radiance * environment_intensity * (f0 * brdf.x + brdf.y) * specular_occlusion(n_dot_v, occlusion, roughness);
}
