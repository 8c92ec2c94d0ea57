#version 460
#extension GL_GOOGLE_include_directive : require
// Step 4 of the source: the mesh through the camera, diffuse from the blurred light map. The specular of the light that
// casts the shadow is dimmed by the blurred light's luminance, which has the shadow in it.
#include "shaders/atlas/light.glsl"
#include "shaders/include/specular.glsl"

layout(scalar) uniform Params {
    float specular_shadow_scale;
    float specular_shadow_bias;
    float occluded;
    float trans_shadow_alpha;
    float cull_bias;
};
uniform texture2D light_map;
layout(constant_id = 1) const int view = 0;
layout(constant_id = 2) const int specular_shadow = 1;
layout(constant_id = 3) const int space = 0;  // 1: mm, alpha tells what was written

layout(location = 0) out vec4 radiance_out;

const int kViewDiffuse = 1, kViewSpecular = 2, kViewLightMap = 3;

float luminance(vec3 c_linear) { return dot(c_linear, vec3(0.2125, 0.7154, 0.0721)); }

void main() {
    Surface s = load_surface();
    // What lies on no texel of the atlas gets its light unblurred, and so does skin seen from inside, through the holes
    // of an open mesh: it counts as facing away, so its texels may have been culled.
    bool from_inside = dot(s.n_geometry_world, s.to_eye_world) + cull_bias <= 0.0;
    vec4 blurred = textureLod(sampler2D(light_map, linear_clamp), s.uv, 0.0);
    vec3 exitance = space == 1 ? blurred.rgb / max(blurred.a, 1e-4) : blurred.rgb;
    if (outside_atlas(s.uv) || from_inside || (space == 1 && blurred.a < 1e-3))
        exitance = unblurred_exitance(s, occluded, trans_shadow_alpha);
    vec3 specular_radiance = environment_specular(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion);
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        float dimmed = 1.0;
        if (i == key_light && specular_shadow != 0) {
            // The source multiplies by the luminance as it is, its light being about 1; here by its share of the light.
            float share = luminance(exitance) / max(luminance(light.irradiance_linear), 1e-4);
            dimmed = clamp(share * specular_shadow_scale + specular_shadow_bias, 0.0, 1.0);
        }
        specular_radiance += light.irradiance_linear * dimmed *
                             specular_reflection(s.n_world, s.to_eye_world, light.to_light_world, s.roughness, s.f0);
    }
    vec3 diffuse_radiance = s.albedo_linear * exitance / kPi;
    vec3 radiance = emission_linear;
    if (view == kViewLightMap) radiance += exitance / kPi;
    else if (view != kViewSpecular) radiance += diffuse_radiance;
    if (view != kViewDiffuse && view != kViewLightMap) radiance += specular_radiance;
    radiance_out = vec4(radiance, 1.0);
}
