#version 460
#extension GL_GOOGLE_include_directive : require
// The mesh through the camera: diffuse from the sum of blurred light maps, specular as every technique has it.
#include "shaders/atlas/final.glsl"

// pre_scatter is a parameter. It stands here because a block of parameters would be the 33rd binding.
layout(push_constant, scalar) uniform PassValues {
    vec3 widest_share_of_gain;
    float pre_scatter;
};
uniform texture2D light_map_lit;     // before the blur
uniform texture2D light_map_widest;  // blurred by the widest Gaussian

// The light that the gain adds or takes comes from farther away than that of the profile (gain_spread.h).
vec3 with_gain(vec3 exitance, vec3 gain_of_place, Surface s) {
    if (gain == kGainNone || gain == kGainLinks) return exitance;
    vec3 widest;
    if (!read_light_map(light_map_widest, s, kTexelsPremultiplied, widest)) widest = exitance;
    return max(exitance + (gain_of_place - 1.0) * mix(exitance, widest, widest_share_of_gain), vec3(0.0));
}

void main() {
    Surface s;
    PixelLight light = light_pixel(s);
    vec3 exitance = scattered_exitance(light_map, light_map_lit, s, light.direct, kTexelsPremultiplied, pre_scatter);
    vec3 specular_radiance = reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion) +
                             light.specular + light.key_specular * shadow_factor(key_light, light.key_passing);
    // The base colour where light enters is taken to be that where it leaves.
    vec3 gain_of_place = gain_at(mean_curvature_per_mm(s));
    exitance = with_gain(exitance, gain_of_place, s) +
               transmitted_gain(gain_of_place) * pow(s.albedo_linear, vec3(pre_scatter)) * light.transmitted;
    if (gain == kGainLinks) exitance = with_links(exitance / pow(s.albedo_linear, vec3(pre_scatter))) * pow(s.albedo_linear, vec3(pre_scatter));
    if (has_scatter != 0) {
        vec3 unscattered = unblurred_exitance(s, light.direct).of_normal * pow(s.albedo_linear, vec3(pre_scatter));
        exitance = mix(unscattered, exitance, scatter_weight(s));
    }
    vec3 diffuse_radiance = diffuse_exit(s) * pow(s.albedo_linear, vec3(1.0 - pre_scatter)) * exitance / kPi;
    radiance_out = vec4(shown_radiance(diffuse_radiance, specular_radiance, exitance / kPi), 1.0);
}
