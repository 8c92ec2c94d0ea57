#ifndef DERMIS_SKIN_PI_GLSL
#define DERMIS_SKIN_PI_GLSL

const float kPi = 3.14159265359;

#endif
