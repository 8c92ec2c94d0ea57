// What every shader may know of the frame. Bindings 0 to 20, and from 40 on, are shared by all shaders; a technique's own
// textures start at 21. Everything is filled by name, so nothing here is written a second time in C++.
#ifndef DERMIS_FRAME_GLSL
#define DERMIS_FRAME_GLSL

#extension GL_EXT_scalar_block_layout : require

const float kPi = 3.14159265359;

layout(set = 0, binding = 0, scalar) uniform Frame {
    mat4 view_projection;
    mat4 inverse_view_projection;
    mat4 light_view_projection;  // of the key light, for the shadow map
    vec3 eye_world_mm;
    float pixel_angle_rad;       // of one pixel at the middle of the picture
    vec3 bounds_center_mm;
    float bounds_radius_mm;
    vec3 background_linear;
    int environment_visible;
    vec3 view_forward_world;
    float environment_intensity;
    float environment_yaw_rad;
    float environment_mip_count;
    int light_count;
    int key_light;               // index into lights, -1: none
    float shadow_texel_mm;       // of the shadow map, at the middle of the scene
    float penumbra_mm;           // full width of the key light's penumbra
    float exposure;              // a factor, 2^exposure_ev
    int second_light;            // the first light that is not the key, -1: none
    mat4 second_light_view_projection;
};

// Directional: intensity_linear is irradiance at normal incidence; point and spot: irradiance at 1 m.
struct LightSource {
    int kind;  // 0 directional, 1 point, 2 spot
    vec3 intensity_linear;
    vec3 to_light_world;
    vec3 position_mm;
    float cos_inner;
    float cos_outer;
};
layout(set = 0, binding = 3, scalar) readonly buffer Lights { LightSource lights[]; };

layout(set = 0, binding = 5) uniform sampler linear_clamp;
layout(set = 0, binding = 6) uniform sampler trilinear_repeat;
layout(set = 0, binding = 7) uniform sampler trilinear_clamp;
layout(set = 0, binding = 8) uniform samplerShadow shadow_compare;
layout(set = 0, binding = 9) uniform sampler nearest_clamp;

#endif
