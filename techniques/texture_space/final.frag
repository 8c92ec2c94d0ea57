#version 460
#extension GL_GOOGLE_include_directive : require
// Step 4 of the source: the mesh through the camera, diffuse from the blurred light map.
#include "shaders/atlas/final.glsl"
#include "techniques/texture_space/constants.h"

uniform texture2D light_map_lit;  // before the blur

layout(constant_id = 2) const int specular_shadow = kSpecularShadowMap;
layout(constant_id = 3) const int light_map_texels = kTexelsPremultiplied;

float luminance(vec3 c_linear) { return dot(c_linear, vec3(0.2125, 0.7154, 0.0721)); }

vec3 key_specular_shadow(Surface s, vec3 passing, vec3 exitance) {
    if (specular_shadow == kSpecularShadowOff) return vec3(1.0);
    if (specular_shadow == kSpecularShadowMap) return shadow_factor(key_light, passing);
    // The source multiplies by the luminance as it is, its light being about 1; here by its share of the key light.
    LightSample key = sample_light(max(key_light, 0), s.p_world_mm);
    float share = luminance(exitance) / max(luminance(key.irradiance_linear), 1e-4);
    return vec3(clamp(share, 0.0, 1.0));
}

void main() {
    Surface s;
    PixelLight light = light_pixel(s);
    vec3 exitance = scattered_exitance(light_map, light_map_lit, s, light.direct, light_map_texels, 0.0);
    vec3 specular_radiance = reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion) +
                             light.specular + light.key_specular * key_specular_shadow(s, light.key_passing, exitance);
    vec3 gain_of_place = gain_at(mean_curvature_per_mm(s));
    exitance = with_links(gain_of_place * exitance + transmitted_gain(gain_of_place) * light.transmitted);
    if (has_scatter != 0) exitance = mix(unblurred_exitance(s, light.direct).of_normal, exitance, scatter_weight(s));
    vec3 diffuse_radiance = diffuse_exit(s) * s.albedo_linear * exitance / kPi;
    radiance_out = vec4(shown_radiance(diffuse_radiance, specular_radiance, exitance / kPi), 1.0);
}
