// The last pass of a technique with a light map: the mesh through the camera, its diffuse light read from the map.
#ifndef DERMIS_ATLAS_FINAL_GLSL
#define DERMIS_ATLAS_FINAL_GLSL

#include "shaders/atlas/constants.h"
#include "shaders/atlas/light.glsl"
#include "shaders/atlas/written.glsl"
#include "shaders/include/specular.glsl"
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

#endif
