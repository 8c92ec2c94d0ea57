// What technique.cpp and the blur agree on. Valid C++ and GLSL, compiled by both, so that a number is written
// once; a change needs a build, as hot reload follows .glsl only.
#ifndef DERMIS_TEXTURE_SPACE_CONSTANTS_H
#define DERMIS_TEXTURE_SPACE_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// Specialisation constant blur_filter.
const int kFilterPoisson = 0, kFilterGaussian = 1, kFilterBox = 2, kFilterKawase = 3;

// Specialisation constant dilate.
const int kDilateOff = 0, kDilateSource = 1, kDilateWrittenOnly = 2;

// Specialisation constant specular_shadow.
const int kSpecularShadowOff = 0, kSpecularShadowSource = 1, kSpecularShadowMap = 2;

// Reading a texture between its texels spreads light like a Gaussian of this variance, in squares of a texel.
const float kBilinearVariance = 1.0f / 6;

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif
