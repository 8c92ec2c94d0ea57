#version 460
#extension GL_GOOGLE_include_directive : require
// Step 4 of the source: the mesh through the camera, diffuse from the blurred light map. The specular of the light that
// casts the shadow is dimmed by the blurred light's luminance, which has the shadow in it.
#include "shaders/atlas/final.glsl"

layout(scalar) uniform Params {
    float specular_shadow_scale;
    float specular_shadow_bias;
};
layout(constant_id = 2) const int specular_shadow = 1;
layout(constant_id = 3) const int space = kSpaceTexels;

float luminance(vec3 c_linear) { return dot(c_linear, vec3(0.2125, 0.7154, 0.0721)); }

void main() {
    Surface s = load_surface();
    vec3 exitance;
    if (!read_light_map(s, space == kSpaceMm, exitance)) exitance = unblurred_exitance(s);
    vec3 specular_radiance = reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion);
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        float dimmed = 1.0;
        if (i == key_light && specular_shadow != 0) {
            // The source multiplies by the luminance itself, for lights of about 1; here it is divided by the light's irradiance.
            float share = luminance(exitance) / max(luminance(light.irradiance_linear), 1e-4);
            dimmed = clamp(share * specular_shadow_scale + specular_shadow_bias, 0.0, 1.0);
        } else if (i != key_light) {
            LightThrough through =
                light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm);
            light.irradiance_linear *= through.visibility * through.tint;
        }
        specular_radiance += light.irradiance_linear * dimmed *
                             specular_reflection(s.n_world, s.to_eye_world, light.to_light_world, s.roughness, s.f0);
    }
    vec3 diffuse_radiance = s.albedo_linear * exitance / kPi;
    radiance_out = vec4(shown_radiance(diffuse_radiance, specular_radiance, exitance / kPi), 1.0);
}
