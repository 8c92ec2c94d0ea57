#version 460
#extension GL_GOOGLE_include_directive : require
// The mesh through the camera: diffuse from the sum of blurred light maps, specular as every technique has it.
#include "shaders/atlas/final.glsl"

layout(scalar) uniform Params { float pre_scatter; };
uniform texture2D light_map_lit;  // before the blur

void main() {
    Surface s;
    PixelLight light = light_pixel(s);
    vec3 exitance = scattered_exitance(light_map, light_map_lit, s, light.direct, kTexelsPremultiplied, pre_scatter);
    vec3 specular_radiance = reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion) +
                             light.specular + light.key_specular * shadow_factor(key_light, light.key_passing);
    // The base colour where light enters is taken to be that where it leaves.
    vec3 gain_of_place = gain_at(mean_curvature_per_mm(s));
    exitance = gain_of_place * exitance +
               transmitted_gain(gain_of_place) * pow(s.albedo_linear, vec3(pre_scatter)) * light.transmitted;
    if (has_scatter != 0) {
        vec3 unscattered = unblurred_exitance(s, light.direct).of_normal * pow(s.albedo_linear, vec3(pre_scatter));
        exitance = mix(unscattered, exitance, scatter_weight(s));
    }
    vec3 diffuse_radiance = diffuse_exit(s) * pow(s.albedo_linear, vec3(1.0 - pre_scatter)) * exitance / kPi;
    radiance_out = vec4(shown_radiance(diffuse_radiance, specular_radiance, exitance / kPi), 1.0);
}
