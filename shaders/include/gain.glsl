// How much more or less a place returns than flat skin: what a normalised profile leaves out (docs/transport.md). The
// includer multiplies the skin's diffuse light by gain_at(), light through thin parts by transmitted_gain(), and the sum
// goes through with_links().
#ifndef DERMIS_GAIN_GLSL
#define DERMIS_GAIN_GLSL

#include "shaders/include/skin/gain.glsl"
#include "shaders/include/surface.glsl"

layout(constant_id = 56) const int gain = kGainNone;

vec3 gain_at(float mean_curvature_per_mm) {
    if (gain == kGainNone || gain == kGainLinks) return vec3(1.0);
    if (gain == kGainMap) return walked_gain_in;
    return gain_of_curvature(mean_curvature_per_mm, gain_slope_mm, gain_length_mm, gain_bend_mm);
}

// Exitance over albedo that links add or take (dermis/rays/vertex_links.h).
vec3 with_links(vec3 exitance) { return gain == kGainLinks ? max(exitance + walked_gain_in, vec3(0.0)) : exitance; }

// Of light from the other side of a thin part, over what the profile passes.
vec3 transmitted_gain(vec3 gain_of_place) {
    return gain == kGainNone ? gain_of_place : gain_through(gain_of_place, slab_gain);
}

#endif
