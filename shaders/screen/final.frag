#version 460
#extension GL_GOOGLE_include_directive : require
// The mesh through the camera: diffuse light from the blurred picture, specular as every technique has it.
#include "shaders/include/gain.glsl"
#include "shaders/include/specular.glsl"
#include "shaders/include/transmission.glsl"
#include "shaders/include/view.glsl"
#include "shaders/screen/light.glsl"
#include "shaders/screen/rays.glsl"

uniform texture2D blurred_light;
uniform texture2D skin_z;
uniform texture2D skin_key_visibility;  // so that the shadow's filter runs once a pixel

layout(constant_id = 37) const int one_sample = 0;  // per pixel, at its centre

layout(location = 0) out vec4 radiance_out;

// The blurred picture has one value per pixel, at its centre. With several samples, one at an edge may show another surface than
// the centre: then the neighbour nearest in depth is read; if none is near, the light is not blurred.
const float kSameSurfaceMm = 3.0;
const float kSeenMm = 0.5;

float gap_mm(ivec2 pixel, float z_mm) {
    ivec2 inside = clamp(pixel, ivec2(0), textureSize(sampler2D(skin_z, nearest_clamp), 0) - 1);
    float stored = texelFetch(sampler2D(skin_z, nearest_clamp), inside, 0).r;
    return stored > 0.0 ? abs(stored - z_mm) : 1e9;
}

ivec2 nearest_in_depth(ivec2 pixel, float z_mm, out float least_mm) {
    ivec2 nearest = pixel;
    least_mm = gap_mm(pixel, z_mm);
    for (int i = 0; least_mm > kSameSurfaceMm && i < 9; ++i) {
        ivec2 other = pixel + ivec2(i % 3 - 1, i / 3 - 1);
        float gap = gap_mm(other, z_mm);
        if (gap < least_mm) least_mm = gap, nearest = other;
    }
    return clamp(nearest, ivec2(0), textureSize(sampler2D(skin_z, nearest_clamp), 0) - 1);
}

bool read_blurred(vec3 p_world_mm, out vec3 exitance, out float key_visibility) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float least_mm = 0.0;
    if (one_sample == 0) pixel = nearest_in_depth(pixel, dot(p_world_mm - eye_world_mm, normalize(toward(vec2(0.0)))), least_mm);
    exitance = texelFetch(sampler2D(blurred_light, nearest_clamp), pixel, 0).rgb;
    key_visibility = texelFetch(sampler2D(skin_key_visibility, nearest_clamp), pixel, 0).r;
    return least_mm <= kSameSurfaceMm;
}

// The blur has only points that the camera sees: none that face away or lie behind other skin.
// Within a pixel the depth changes by about the pixel's own size.
float pixel_mm;
const float kFacesAway = 0.3;  // cosine

float part_not_counted(LightMap map, LitPoint lit) {
    vec3 p_from_eye_mm = p_world_mm_in - eye_world_mm + to_world(map, lit.offset_mm);
    vec4 p_clip = view_projection * vec4(p_from_eye_mm, 0.0);  // of the eye, x, y and w are 0
    vec2 at = p_clip.xy / p_clip.w * 0.5 + 0.5;
    ivec2 size = textureSize(sampler2D(skin_z, nearest_clamp), 0);
    ivec2 pixel = ivec2(floor(at * vec2(size)));
    bool outside = any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size));
    float z_mm = outside ? 0.0 : texelFetch(sampler2D(skin_z, nearest_clamp), pixel, 0).r;
    float margin_mm = kSeenMm + 0.5 * pixel_mm;
    // Beyond the border of the picture the blur repeats the light at the border.
    float hidden = z_mm == 0.0 ? float(!outside) : smoothstep(margin_mm, 2.0 * margin_mm, p_clip.w - z_mm);
    if (hidden == 1.0) return 1.0;
    float away = dot(to_world(map, lit.n), normalize(p_from_eye_mm));
    return max(hidden, smoothstep(0.0, kFacesAway, away));
}

// Results of the taps in the light's maps. They need geometry, normal and the key light's visibility only.
struct Arrival {
    LightSample light;
    float visibility;
    vec3 tint, transmitted;
};

Arrival arrival(Surface s, int i, float key_visibility) {
    LightSample light = sample_light(i, s.p_world_mm);
    LightThrough through = LightThrough(key_visibility, vec3(1.0));
    // The first pass stored the key light's visibility, but not the tint of its shadow.
    if (i != key_light || tinted_shadows != 0)
        through = light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm);
    vec3 transmitted = transmitted_part(s, i, light.to_light_world, dot(s.n_world, light.to_light_world),
                                        through.visibility, -1.0);
    return Arrival(light, through.visibility, through.tint, transmitted);
}

void main() {
    Surface s = load_geometry();
    load_normal(s);
    load_occlusion(s);
    // More is needed only where the reflection reduces the diffuse light.
    if (reduced_diffuse != 0) load_gloss(s);
    pixel_mm = length(fwidth(s.p_world_mm));
    vec3 exitance;
    float key_visibility;
    if (!read_blurred(s.p_world_mm, exitance, key_visibility)) exitance = unblurred_exitance(s, key_visibility);
    Arrival first;
    if (one_light != 0) first = arrival(s, 0, key_visibility);
    load_gloss(s);
    vec3 specular_radiance = vec3(0.0);
    vec3 gain_of_place = gain_at(mean_curvature_per_mm(s)), through = transmitted_gain(gain_of_place);
    exitance *= gain_of_place;
    [[unroll]] for (int i = 0; i < light_count; ++i) {
        Arrival arriving;
        if (one_light != 0)
            arriving = first;
        else
            arriving = arrival(s, i, key_visibility);
        vec3 light = arriving.light.irradiance_linear;
        exitance += light * (s.occlusion * arriving.transmitted) * through;
        specular_radiance +=
            light * arriving.visibility * arriving.tint *
            specular_reflection(s.n_world, s.to_eye_world, arriving.light.to_light_world, s.roughness, s.f0);
    }
    specular_radiance += reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion);
    exitance = with_links(exitance);
    if (has_scatter != 0) {
        float of_key;
        exitance = mix(unblurred_exitance(s, of_key), exitance, scatter_weight(s));
    }
    load_albedo(s);
    vec3 diffuse_radiance = diffuse_exit(s) * s.albedo_linear * exitance / kPi;
    radiance_out = vec4(shown_radiance(diffuse_radiance, specular_radiance, exitance / kPi), 1.0);
}
