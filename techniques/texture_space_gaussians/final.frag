#version 460
#extension GL_GOOGLE_include_directive : require
// The mesh through the camera: diffuse from the sum of blurred light maps, specular as every technique has it.
#include "shaders/atlas/light.glsl"
#include "shaders/include/specular.glsl"

layout(scalar) uniform Params {
    float occluded;
    float trans_shadow_alpha;
    float cull_bias;
    float pre_scatter;
};
uniform texture2D light_map;
layout(constant_id = 1) const int view = 0;

layout(location = 0) out vec4 radiance_out;

const int kViewDiffuse = 1, kViewSpecular = 2, kViewLightMap = 3;

void main() {
    Surface s = load_surface();
    // Seen from inside, or on no texel of the atlas: unblurred.
    bool from_inside = dot(s.n_geometry_world, s.to_eye_world) + cull_bias <= 0.0;
    vec4 blurred = textureLod(sampler2D(light_map, linear_clamp), s.uv, 0.0);
    vec3 albedo_after = pow(s.albedo_linear, vec3(1.0 - pre_scatter));
    vec3 exitance = blurred.rgb / max(blurred.a, 1e-4);
    if (outside_atlas(s.uv) || from_inside || blurred.a < 1e-3)
        exitance = unblurred_exitance(s, occluded, trans_shadow_alpha) * pow(s.albedo_linear, vec3(pre_scatter));
    vec3 specular_radiance = environment_specular(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion);
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        vec3 arriving = light.irradiance_linear;
        if (i == key_light)
            arriving *= key_light_through(s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm,
                                          trans_shadow_alpha);
        specular_radiance +=
            arriving * specular_reflection(s.n_world, s.to_eye_world, light.to_light_world, s.roughness, s.f0);
    }
    vec3 radiance = emission_linear;
    if (view == kViewLightMap) radiance += exitance / kPi;
    else if (view != kViewSpecular) radiance += albedo_after * exitance / kPi;
    if (view != kViewDiffuse && view != kViewLightMap) radiance += specular_radiance;
    radiance_out = vec4(radiance, 1.0);
}
