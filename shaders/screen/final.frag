#version 460
#extension GL_GOOGLE_include_directive : require
// The mesh through the camera: diffuse light from the blurred picture, specular as every technique has it.
#include "shaders/include/specular.glsl"
#include "shaders/include/view.glsl"
#include "shaders/screen/light.glsl"
#include "shaders/screen/rays.glsl"

uniform texture2D blurred_light;
uniform texture2D skin_z;
uniform texture2D skin_key_visibility;  // so that the shadow's filter runs once a pixel

layout(location = 0) out vec4 radiance_out;

// The blurred picture has one value per pixel, at its middle. A sample at an edge may be of another surface than the
// middle: then the neighbour nearest in depth is taken, and where none is near, the light is not blurred at all.
const float kSameSurfaceMm = 3.0;

float gap_mm(ivec2 pixel, float z_mm) {
    ivec2 inside = clamp(pixel, ivec2(0), textureSize(sampler2D(skin_z, nearest_clamp), 0) - 1);
    float stored = texelFetch(sampler2D(skin_z, nearest_clamp), inside, 0).r;
    return stored > 0.0 ? abs(stored - z_mm) : 1e9;
}

bool read_blurred(vec3 p_world_mm, out vec3 exitance, out float key_visibility) {
    float z_mm = dot(p_world_mm - eye_world_mm, normalize(toward(vec2(0.0))));
    ivec2 pixel = ivec2(gl_FragCoord.xy), nearest = pixel;
    float least = gap_mm(pixel, z_mm);
    for (int i = 0; least > kSameSurfaceMm && i < 9; ++i) {
        ivec2 other = pixel + ivec2(i % 3 - 1, i / 3 - 1);
        float gap = gap_mm(other, z_mm);
        if (gap < least) least = gap, nearest = other;
    }
    ivec2 inside = clamp(nearest, ivec2(0), textureSize(sampler2D(skin_z, nearest_clamp), 0) - 1);
    exitance = texelFetch(sampler2D(blurred_light, nearest_clamp), inside, 0).rgb;
    key_visibility = texelFetch(sampler2D(skin_key_visibility, nearest_clamp), inside, 0).r;
    return least <= kSameSurfaceMm;
}

void main() {
    Surface s = load_surface();
    vec3 exitance;
    float key_visibility;
    if (!read_blurred(s.p_world_mm, exitance, key_visibility)) exitance = unblurred_exitance(s, key_visibility);
    vec3 specular_radiance = reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion);
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        // The first pass stored the key light's visibility, but not the tint of its shadow.
        if (i == key_light && tinted_shadows == 0) {
            light.irradiance_linear *= key_visibility;
        } else {
            LightThrough through =
                light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm);
            light.irradiance_linear *= through.visibility * through.tint;
        }
        specular_radiance += light.irradiance_linear *
                             specular_reflection(s.n_world, s.to_eye_world, light.to_light_world, s.roughness, s.f0);
    }
    radiance_out = vec4(shown_radiance(s.albedo_linear * exitance / kPi, specular_radiance, exitance / kPi), 1.0);
}
