#version 460
#extension GL_GOOGLE_include_directive : require
// The surface itself, one attribute a target: for debug views, layered EXR, and techniques that ask for it.
#include "shaders/include/cut_out.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/include/shadow.glsl"
#include "shaders/include/surface.glsl"

layout(location = 0) out vec4 position_out;   // world, mm; distance to the eye in mm
layout(location = 1) out vec4 normal_out;     // world, with the normal map; curvature in 1/mm, or tension
layout(location = 2) out vec4 geometry_out;   // world normal without the map; occlusion
layout(location = 3) out vec4 albedo_out;     // linear; roughness
layout(location = 4) out vec4 light_out;      // uv; n_dot_l of the key light; its visibility

layout(constant_id = 41) const int shows_tension = 0;
layout(constant_id = 40) const int has_cut_outs = 0;  // without it depth is tested before the shader runs

void main() {
    if (has_cut_outs != 0 && cut_out()) discard;
    Surface s = load_surface();
    position_out = vec4(s.p_world_mm, distance(s.p_world_mm, eye_world_mm));
    normal_out = vec4(s.n_world, shows_tension != 0 ? tension_in : mean_curvature_per_mm(s));
    geometry_out = vec4(s.n_geometry_world, s.occlusion);
    albedo_out = vec4(s.albedo_linear, s.roughness);
    float n_dot_l = 0.0, visibility = 1.0;
    if (key_light >= 0) {
        vec3 to_light = sample_light(key_light, s.p_world_mm).to_light_world;
        n_dot_l = dot(s.n_world, to_light);
        if (light_source(key_light).shadow_map_index >= 0)
            visibility = shadow_visibility(s.p_world_mm, s.n_geometry_world, to_light, penumbra_mm);
    }
    light_out = vec4(s.uv, n_dot_l, visibility);
}
