// Light that the surface emits: the constant times the map.
#ifndef DERMIS_EMISSION_GLSL
#define DERMIS_EMISSION_GLSL

#include "shaders/include/surface.glsl"

uniform sampler2D emission_map;

vec3 emitted_radiance() {
    return emission_from_map != 0 ? emission_linear * texture(emission_map, uv_in).rgb : emission_linear;
}

#endif
