// Cards of hair and lashes: no surface where the alpha map has too little (dermis::cutoff_of_map). The reference has the
// same rule, at the map's full resolution (dermis/rays/texture.h).
#ifndef DERMIS_CUT_OUT_GLSL
#define DERMIS_CUT_OUT_GLSL

#include "shaders/include/surface.glsl"

uniform sampler2D alpha_map;

float map_alpha() {
    return texture(alpha_map, uv_in).r * color_linear_in.a;
}

bool cut_out() {
    return map_alpha() < alpha_cutoff;
}

#endif
