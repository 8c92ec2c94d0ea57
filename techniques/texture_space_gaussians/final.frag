#version 460
#extension GL_GOOGLE_include_directive : require
// The mesh through the camera: diffuse from the sum of blurred light maps, specular as every technique has it.
#include "shaders/atlas/final.glsl"

layout(scalar) uniform Params { float pre_scatter; };

void main() {
    Surface s = load_surface();
    vec3 exitance;
    if (!read_light_map(s, true, exitance))
        exitance = unblurred_exitance(s) * pow(s.albedo_linear, vec3(pre_scatter));
    vec3 specular_radiance = reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion);
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        vec3 arriving = light.irradiance_linear;
        if (i == key_light) {
            arriving *= key_light_through(s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm,
                                          trans_shadow_alpha);
        } else {
            LightThrough through =
                light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm);
            arriving *= through.visibility * through.tint;
        }
        specular_radiance +=
            arriving * specular_reflection(s.n_world, s.to_eye_world, light.to_light_world, s.roughness, s.f0);
    }
    vec3 diffuse_radiance = pow(s.albedo_linear, vec3(1.0 - pre_scatter)) * exitance / kPi;
    radiance_out = vec4(shown_radiance(diffuse_radiance, specular_radiance, exitance / kPi), 1.0);
}
