// The last pass of a technique with a light map: the mesh through the camera, its diffuse light read from the map.
#ifndef DERMIS_ATLAS_FINAL_GLSL
#define DERMIS_ATLAS_FINAL_GLSL

#include "shaders/atlas/constants.h"
#include "shaders/atlas/light.glsl"
#include "shaders/atlas/written.glsl"
#include "shaders/include/specular.glsl"
#include "shaders/include/transmission.glsl"
#include "shaders/include/view.glsl"

uniform texture2D light_map;

layout(location = 0) out vec4 radiance_out;

// Other UDIM tiles, UVs that run over the edge.
bool outside_atlas(vec2 uv) { return any(greaterThan(abs(uv - 0.5), vec2(0.5001))); }

// False where the light map does not have the point: outside the atlas, between texels of which none was written, and on
// skin seen from inside, through the holes of an open mesh. That counts as facing away, so that its texels may have been culled.
bool read_light_map(texture2D map, Surface s, int texels, out vec3 exitance) {
    vec4 blurred = texels == kTexelsWritten ? light_and_coverage(map, s.uv)
                                            : textureLod(sampler2D(map, linear_clamp), s.uv, 0.0);
    if (texels == kTexelsAsTheyAre) blurred.a = 1.0;
    exitance = blurred.rgb / max(blurred.a, 1e-4);
    bool from_inside = dot(s.n_geometry_world, s.to_eye_world) + cull_bias <= 0.0;
    return !(outside_atlas(s.uv) || from_inside || blurred.a < 1e-3);
}

layout(constant_id = 4) const int detail = kDetailPixel;

// What the map's texels are too coarse for stays at the pixel: light there, and what the blur adds to the map or takes from
// it. `map` is blurred, `map_lit` is before the blur. The light at the pixel takes in albedo ^ pre_scatter, as the map does.
vec3 scattered_exitance(texture2D map, texture2D map_lit, Surface s, int texels, float pre_scatter) {
    vec3 blurred, lit;
    bool found = read_light_map(map, s, texels, blurred);
    if (found && detail == kDetailMap) return blurred;
    vec3 here = unblurred_exitance(s);
    if (pre_scatter > 0.0) here *= pow(s.albedo_linear, vec3(pre_scatter));
    if (!found) return here;
    read_light_map(map_lit, s, texels, lit);
    return max(here + blurred - lit, vec3(0.0));
}

// The blur reaches what is near along the surface, however that bends, but not through. Points of one surface that are near
// have normals that differ little; opposite walls of a thin part have opposite ones. Around spheres of 4 and 8 mm blur and
// transmission then come to 0.85 to 1.02 times the integral, of 2 mm to 1.1 to 1.4 (an even blur along the surface alone to
// 0.8 to 1.0), where a point that counts in full wherever it is would come to 1.3 to 2.
float part_not_counted(Surface s, LitPoint lit) {
    float turned = turned_away(s, lit);
    return turned * turned;
}

// `passing`: what arrives of the light past opaque and translucent surfaces.
vec3 transmitted_past(Surface s, int i, LightSample light, vec3 passing) {
    if (transmission == kTransmissionNone) return vec3(0.0);
    float n_dot_l = max(dot(s.n_world, light.to_light_world), 0.0), visibility = passing.r;
    if (tinted_shadows != 0 && n_dot_l > 0.0)
        visibility = light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm).visibility;
    return transmitted_exitance(s, i, light, n_dot_l, visibility, -1.0);
}

#endif
