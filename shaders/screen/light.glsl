// The diffuse light of a point of skin before anything blurs it: what techniques that work on the picture blur.
#ifndef DERMIS_SCREEN_LIGHT_GLSL
#define DERMIS_SCREEN_LIGHT_GLSL

#include "shaders/include/environment.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/include/reduced_diffuse.glsl"
#include "shaders/include/shadow.glsl"
#include "shaders/include/surface.glsl"

// Exitance over albedo; and how much of the key light arrives, 0 where the skin faces away from it.
vec3 unblurred_exitance(Surface s, out float key_visibility) {
    vec3 exitance = environment_irradiance(s.n_world) * s.occlusion;
    key_visibility = 0.0;
    [[unroll]] for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        float n_dot_l = dot(s.n_world, light.to_light_world);
        if (n_dot_l <= 0.0) continue;
        LightThrough through =
            light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm);
        if (i == key_light) key_visibility = through.visibility;
        exitance += light.irradiance_linear * n_dot_l * diffuse_entry(s, n_dot_l) * through.visibility * through.tint;
    }
    return exitance;
}

#endif
