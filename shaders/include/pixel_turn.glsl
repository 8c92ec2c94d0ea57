// A different angle for each pixel, evenly distributed in any 3 x 3 block.
#ifndef DERMIS_PIXEL_TURN_GLSL
#define DERMIS_PIXEL_TURN_GLSL

#include "shaders/include/frame.glsl"

// Interleaved gradient noise (Jimenez 2014).
float pixel_turn(vec2 pixel) {
    return 2.0 * kPi * fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

#endif
