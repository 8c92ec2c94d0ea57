#version 460
#extension GL_GOOGLE_include_directive : require
// The mesh through the camera: diffuse from the sum of blurred light maps, specular as every technique has it.
#include "shaders/atlas/final.glsl"

layout(scalar) uniform Params { float pre_scatter; };
uniform texture2D light_map_lit;  // before the blur

void main() {
    Surface s = load_surface();
    vec3 exitance = scattered_exitance(light_map, light_map_lit, s, kTexelsPremultiplied, pre_scatter);
    vec3 transmitted = vec3(0.0);
    vec3 specular_radiance = reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion);
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        vec3 through = passing(s, i, light.to_light_world);
        transmitted += transmitted_past(s, i, light, through);
        specular_radiance += light.irradiance_linear * through *
                             specular_reflection(s.n_world, s.to_eye_world, light.to_light_world, s.roughness, s.f0);
    }
    // The base colour where light enters is taken to be that where it leaves.
    exitance += pow(s.albedo_linear, vec3(pre_scatter)) * transmitted;
    vec3 diffuse_radiance = diffuse_exit(s) * pow(s.albedo_linear, vec3(1.0 - pre_scatter)) * exitance / kPi;
    radiance_out = vec4(shown_radiance(diffuse_radiance, specular_radiance, exitance / kPi), 1.0);
}
