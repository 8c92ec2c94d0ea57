// What C++ and the shaders of this technique agree on. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_SCREEN_SPACE_BURLEY_CONSTANTS_H
#define DERMIS_SCREEN_SPACE_BURLEY_CONSTANTS_H
#ifdef __cplusplus
namespace dermis::screen_space_burley {
#endif

// count=adaptive: samples for each 2 x 2 pixels from which the variance is estimated; samples where it is 0;
// and the power of the count with which the spiral's variance falls. Measured: 4.9 dB for twice as many
// samples, on spheres and bust; independent samples have 3.
const int kPilotSamples = 4, kFewestSamples = 4;
const float kConvergence = 1.6;

// accumulate=frames: as many frames count as much as each other, at most; fewer while a light changes.
const int kMostFrames = 32, kFramesOfChangingLight = 4;

#ifdef __cplusplus
}  // namespace dermis::screen_space_burley
#endif
#endif
