// What C++ and the shaders of this technique agree on. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_SCREEN_SPACE_BURLEY_CONSTANTS_H
#define DERMIS_SCREEN_SPACE_BURLEY_CONSTANTS_H
#ifdef __cplusplus
namespace dermis::screen_space_burley {
#endif

// Texels of the tables over distance and over the part of the light.
const float kDensityTexels = 512.0, kRadiusTexels = 512.0;

#ifdef __cplusplus
}  // namespace dermis::screen_space_burley
#endif
#endif
