// The values of the frame that every shader may read. They are set by name, so that C++ does not repeat the layout,
// and no shader numbers its bindings: glslc assigns the numbers, the program finds them by reflection.
#ifndef DERMIS_FRAME_GLSL
#define DERMIS_FRAME_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "shaders/include/constants.h"
#include "shaders/include/skin/pi.glsl"

// Directional: intensity_linear is irradiance at normal incidence; point and spot: irradiance at 1 m.
struct LightSource {
    int kind;  // kLightDirectional, ...
    vec3 intensity_linear;
    vec3 to_light_world;
    vec3 position_mm;
    float cos_inner;
    float cos_outer;
    int shadow_map_index;  // -1: casts no shadow
    mat4 light_view_projection;
    // Of a directional light: the axes of its shadow map across to_light_world, a millimetre along either in the map's
    // texture coordinates, and the way towards the light for a difference of 1 in the map's depth.
    vec3 x_world, y_world;
    float map_per_mm;
    float mm_per_map_z;
};

layout(scalar) uniform Frame {
    mat4 view_projection;
    mat4 inverse_view_projection;
    mat4 light_view_projection;  // of the key light, for the shadow map
    vec3 eye_world_mm;
    vec3 bounds_center_mm;
    float bounds_radius_mm;
    vec3 background_linear;
    int environment_visible;
    float environment_intensity;
    vec2 environment_turn;       // cosine and sine of its yaw
    // Of 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2 in the world: its radiance up to the second order, intensity included.
    vec3 environment_terms[9];
    float environment_mip_count;
    int frame_light_count;       // light_count of lights.glsl is to be used
    int key_light;               // index into lights, -1: none
    float shadow_map_texels;     // along a side of each shadow map
    float shadow_texel_mm;       // of the shadow map, at the middle of the scene
    float penumbra_mm;           // full width of the key light's penumbra
    float exposure;              // a factor, 2^exposure_ev
    int second_light;            // the first light that is not the key, -1: none
    mat4 second_light_view_projection;
    float pixel_per_distance;    // side of a pixel over its distance along the view
    // Of the skin's gain (shaders/include/skin/gain.glsl); 0 where no pass asks for it.
    vec3 gain_slope_mm, gain_length_mm, gain_bend_mm, slab_gain;
    LightSource first_light;     // lights[0]
};

layout(scalar) readonly buffer Lights { LightSource lights[]; };

uniform sampler linear_clamp;
uniform sampler trilinear_clamp;  // also for images of one level, to save a binding: drivers push 32 at most
uniform samplerShadow shadow_compare;
uniform sampler nearest_clamp;

#endif
