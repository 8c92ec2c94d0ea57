// The diffuse light of a point of skin before anything blurs it: what techniques with a light map write there.
#ifndef DERMIS_ATLAS_LIGHT_GLSL
#define DERMIS_ATLAS_LIGHT_GLSL

#include "shaders/include/environment.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/atlas/shadow_channels.glsl"
#include "shaders/include/reduced_diffuse.glsl"
#include "shaders/include/surface.glsl"

// Of dermis::AtlasParams, what shaders need.
layout(scalar) uniform AtlasParams {
    float occluded;
    float trans_shadow_alpha;
    float cull_bias;
};

// What passes opaque and translucent surfaces.
vec3 passing(Surface s, int light, vec3 to_light_world) {
    if (light == key_light)
        return key_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, trans_shadow_alpha);
    if (channels == kChannelsTwoLights && light == second_light)
        return second_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, trans_shadow_alpha);
    LightThrough other = light_through(light, s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm);
    return other.visibility * other.tint;
}

vec3 shadow_factor(vec3 passing) { return mix(vec3(occluded), vec3(1.0), passing); }

// Exitance over albedo, of one light.
vec3 light_exitance(Surface s, int i) {
    LightSample light = sample_light(i, s.p_world_mm);
    float n_dot_l = dot(s.n_world, light.to_light_world);
    if (n_dot_l <= 0.0) return vec3(0.0);
    return light.irradiance_linear * n_dot_l * diffuse_entry(s, n_dot_l) * shadow_factor(passing(s, i, light.to_light_world));
}

// By the shading normal, and by the mean of the normal map's normals that it is made of: N.L of that mean is the mean of N.L.
struct Exitance {
    vec3 of_normal, of_mean;
};

Exitance unblurred_exitance(Surface s) {
    vec3 direct = vec3(0.0);
    for (int i = 0; i < light_count; ++i) direct += light_exitance(s, i);
    return Exitance(environment_irradiance(s.n_world) * s.occlusion + direct,
                    environment_irradiance(s.n_mean_world) * s.occlusion + direct * length(s.n_mean_world));
}

#endif
