// The diffuse light of a point of skin before anything blurs it: what techniques that work in the atlas put there.
#ifndef DERMIS_ATLAS_LIGHT_GLSL
#define DERMIS_ATLAS_LIGHT_GLSL

#include "shaders/include/environment.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/atlas/shadow_channels.glsl"
#include "shaders/include/surface.glsl"

// `occluded`: share of the light that full shadow leaves. `darkening`: larger values make translucent shadows darker.
vec3 shadow_factor(Surface s, int light, vec3 to_light_world, float occluded, float darkening) {
    vec3 through = vec3(1.0);
    if (light == key_light)
        through = key_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, darkening);
    else if (channels == kChannelsTwoLights && light == second_light)
        through =
            second_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, darkening);
    return mix(vec3(occluded), vec3(1.0), through);
}

// Exitance over albedo.
vec3 unblurred_exitance(Surface s, float occluded, float darkening) {
    vec3 exitance = environment_irradiance(s.n_world) * s.occlusion;
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        float n_dot_l = dot(s.n_world, light.to_light_world);
        if (n_dot_l > 0.0)
            exitance += light.irradiance_linear * n_dot_l *
                        shadow_factor(s, i, light.to_light_world, occluded, darkening);
    }
    return exitance;
}

// Whether a point has no place in the atlas: other UDIM tiles, UVs that run over the edge.
bool outside_atlas(vec2 uv) { return any(greaterThan(abs(uv - 0.5), vec2(0.5001))); }

#endif
