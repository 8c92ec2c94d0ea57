// What C++ and the shaders of this technique agree on. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_SCREEN_SPACE_SEPARABLE_CONSTANTS_H
#define DERMIS_SCREEN_SPACE_SEPARABLE_CONSTANTS_H
#ifdef __cplusplus
namespace dermis::screen_space_separable {
#endif

// Reach of the kernel in standard deviations of the widest Gaussian.
const float kReachSigma = 3.0;

// Specialisation constant `follow`: how the distance to a tap is measured.
const int kFollowNone = 0, kFollowSurface = 1;

#ifdef __cplusplus
}  // namespace dermis::screen_space_separable
#endif
#endif
