// The diffuse light of a point of skin before anything blurs it: what techniques with a light map write there.
#ifndef DERMIS_ATLAS_LIGHT_GLSL
#define DERMIS_ATLAS_LIGHT_GLSL

#include "shaders/include/environment.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/atlas/shadow_channels.glsl"
#include "shaders/include/surface.glsl"

// Of dermis::AtlasParams, what shaders need.
layout(scalar) uniform AtlasParams {
    float occluded;
    float trans_shadow_alpha;
    float cull_bias;
};

vec3 shadow_factor(Surface s, int light, vec3 to_light_world) {
    vec3 through = vec3(1.0);
    if (light == key_light)
        through =
            key_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, trans_shadow_alpha);
    else if (channels == kChannelsTwoLights && light == second_light)
        through =
            second_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, trans_shadow_alpha);
    else {
        LightThrough other = light_through(light, s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm);
        through = other.visibility * other.tint;
    }
    return mix(vec3(occluded), vec3(1.0), through);
}

// Exitance over albedo.
vec3 unblurred_exitance(Surface s) {
    vec3 exitance = environment_irradiance(s.n_world) * s.occlusion;
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        float n_dot_l = dot(s.n_world, light.to_light_world);
        if (n_dot_l > 0.0)
            exitance += light.irradiance_linear * n_dot_l * shadow_factor(s, i, light.to_light_world);
    }
    return exitance;
}

#endif
