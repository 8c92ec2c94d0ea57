// Light that the surface emits: the constant times the map.
#ifndef DERMIS_EMISSION_GLSL
#define DERMIS_EMISSION_GLSL

#include "shaders/include/surface.glsl"

layout(constant_id = 55) const int has_emission_map = 1;
uniform sampler2D emission_map;

vec3 emitted_radiance() {
    return has_emission_map != 0 && emission_from_map != 0 ? emission_linear * texture(emission_map, uv_in).rgb : emission_linear;
}

#endif
