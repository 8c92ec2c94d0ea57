#version 460
#extension GL_GOOGLE_include_directive : require
// Surfaces other than skin: eyes, teeth, hair, frames, glass. glTF's metallic-roughness.
#include "shaders/include/cut_out.glsl"
#include "shaders/include/emission.glsl"
#include "shaders/include/environment.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/include/shadow.glsl"
#include "shaders/include/specular.glsl"
#include "shaders/include/surface.glsl"
#include "shaders/renderer/constants.h"

uniform sampler2D metallic_map;

layout(location = 0) out vec4 radiance_out;

layout(constant_id = 40) const int has_cut_outs = 0;  // without it depth is tested before the shader runs
layout(constant_id = 41) const int blended = kBlendedNot;

void main() {
    float alpha = 1.0;
    if (blended != kBlendedNot) {
        alpha = opacity * map_alpha();
        if (alpha == 0.0 || (alpha < 0.5) != (blended == kBlendedRim)) discard;
    } else if (has_cut_outs != 0 && cut_out()) {
        discard;
    }
    Surface s = load_surface();
    if (!gl_FrontFacing) {
        s.n_world = -s.n_world;
        s.n_geometry_world = -s.n_geometry_world;
    }
    // A metal's F0 is its colour; the models take one number, so its colour multiplies the result.
    float metal = metallic * texture(metallic_map, s.uv).r;
    float f0_one = mix(s.f0, 1.0, metal);
    vec3 specular_tint = mix(vec3(1.0), s.albedo_linear, metal);
    vec3 exitance = environment_irradiance(s.n_world) * s.occlusion;
    vec3 specular_radiance =
        environment_specular(kBrdfLobeGgx, s.n_world, s.to_eye_world, s.roughness, f0_one, s.occlusion);
    [[unroll]] for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        LightThrough through =
            light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm);
        vec3 irradiance = light.irradiance_linear * through.visibility * through.tint;
        exitance += irradiance * max(dot(s.n_world, light.to_light_world), 0.0);
        specular_radiance += irradiance * specular_reflection(s.n_world, s.to_eye_world, light.to_light_world,
                                                              s.roughness, f0_one);
    }
    vec3 diffuse_radiance = s.albedo_linear * (1.0 - metal) * exitance / kPi;
    if (blended != kBlendedNot)
        radiance_out = vec4(emitted_radiance() + diffuse_radiance + specular_radiance * specular_tint, alpha);
    else
        radiance_out =
            vec4(emitted_radiance() + diffuse_radiance * opacity + specular_radiance * specular_tint, opacity);
}
