// Light that arrives at a point: irradiance at normal incidence and its direction.
#ifndef DERMIS_LIGHTS_GLSL
#define DERMIS_LIGHTS_GLSL

#include "shaders/include/frame.glsl"

// 1 in a frame with one light. Loops over lights are marked [[unroll]], so that a compiler removes the loop for one light
// in spite of its long body. With an unknown count the loop stays.
#extension GL_EXT_control_flow_attributes : require
layout(constant_id = 35) const int one_light = 0;
// 1 in a frame whose lights are all directional: their axes and maps are then the same for all pixels.
layout(constant_id = 36) const int all_directional = 0;
int light_count = one_light != 0 ? 1 : frame_light_count;

// A uniform block is read once for many pixels, a storage buffer by each.
LightSource light_source(int index) {
    if (one_light != 0) return first_light;
    return lights[index];
}

struct LightSample {
    vec3 irradiance_linear;  // on a surface that faces the light
    vec3 to_light_world;
};

// Inverse-square falloff in metres; a spot fades between its angles as a squared smooth ramp of the cosine (glTF
// KHR_lights_punctual).
LightSample sample_light(int index, vec3 p_world_mm) {
    LightSource light = light_source(index);
    if (all_directional != 0 || light.kind == kLightDirectional)
        return LightSample(light.intensity_linear, light.to_light_world);
    vec3 offset_mm = light.position_mm - p_world_mm;
    float distance_m = max(length(offset_mm) * 1e-3, 1e-3);
    vec3 to_light = normalize(offset_mm);
    float cone = 1.0;
    if (light.kind == kLightSpot) {
        float cos_axis = dot(to_light, light.to_light_world);
        float ramp = clamp((cos_axis - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-4), 0.0, 1.0);
        cone = ramp * ramp;
    }
    return LightSample(light.intensity_linear * cone / (distance_m * distance_m), to_light);
}

#endif
