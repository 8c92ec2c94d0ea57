// What a translucent surface lets through: its opacity map's colour, or else base colour times what is not covered. The
// reference has the same rule (MaterialSet::transmittance_at).
#ifndef DERMIS_TRANSLUCENT_GLSL
#define DERMIS_TRANSLUCENT_GLSL

#include "shaders/include/surface.glsl"

uniform sampler2D opacity_map;

vec3 surface_transmittance() {
    if (opacity_from_map == 0) return albedo_linear * (1.0 - opacity);
    return texture(opacity_map, uv_in).rgb;
}

#endif
