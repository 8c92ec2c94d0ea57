// Values that are stored in half floats.
#ifndef DERMIS_HALF_FLOATS_GLSL
#define DERMIS_HALF_FLOATS_GLSL

// To the nearest half float, so that storing it is exact (Veltkamp 1968's splitting, of 13 bits). Vulkan leaves open how
// a value between two half floats is rounded; a driver that cuts it off takes up to 1/1024 of the light in every pass.
// Above the largest half float drivers store it, infinity or NaN, and a blur of infinite light is NaN.
vec4 half_rounded(vec4 value) {
    value = min(value, vec4(65504.0));
    precise vec4 scaled = value * 8193.0;
    precise vec4 beyond = scaled - value;
    precise vec4 rounded = scaled - beyond;
    return rounded;
}

#endif
