// The diffuse light of a point of skin before anything blurs it: what techniques with a light map write there.
#ifndef DERMIS_ATLAS_LIGHT_GLSL
#define DERMIS_ATLAS_LIGHT_GLSL

#include "shaders/include/environment.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/atlas/shadow_channels.glsl"
#include "shaders/include/reduced_diffuse.glsl"
#include "shaders/include/surface.glsl"

// Of atlas_skin_values() in dermis/technique/atlas_light.h.
layout(scalar) uniform Skin {
    vec3 detail_kept[kDetailSamples];
    float occluded;
    float trans_shadow_alpha;
};

// The light past opaque and translucent surfaces.
vec3 passing(Surface s, int light, vec3 to_light_world) {
    if (light == key_light && light_source(light).shadow_map_index >= 0)
        return key_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, trans_shadow_alpha);
    if (channels == kChannelsTwoLights && light == second_light)
        return second_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, trans_shadow_alpha);
    LightThrough other = light_through(light, s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm);
    return other.visibility * other.tint;
}

// `occluded` is the share of the key light that remains in full shadow.
vec3 shadow_factor(int light, vec3 passing) { return light == key_light ? mix(vec3(occluded), vec3(1.0), passing) : passing; }

// E = N.L times the light's irradiance. With the source's shadows it is saturated in each channel, as the source does:
// radiance over albedo, E / pi, is at most 1.
vec3 arriving_irradiance(LightSample light, float n_dot_l) {
    vec3 irradiance = light.irradiance_linear * n_dot_l;
    return shadow_lookup == kLookupSingle ? min(irradiance, vec3(kPi)) : irradiance;
}

// N.L by the shading normal, and by the mean of the normal map's normals: N.L of that mean is the mean of N.L.
struct Exitance {
    vec3 of_normal, of_mean;
};

// Exitance over albedo; `direct` is the part of the lights, by the shading normal.
Exitance unblurred_exitance(Surface s, vec3 direct) {
    return Exitance(environment_irradiance(s.n_world) * s.occlusion + direct,
                    environment_irradiance(s.n_mean_length * s.n_world) * s.occlusion + direct * s.n_mean_length);
}

#endif
