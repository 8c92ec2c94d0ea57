// What technique.cpp and the blur agree on. Valid C++ and GLSL, compiled by both, so that a number is written
// once; a change needs a build, as hot reload follows .glsl only.
#ifndef DERMIS_TEXTURE_SPACE_CONSTANTS_H
#define DERMIS_TEXTURE_SPACE_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// Specialisation constant blur_filter. 0 is the fit to the profile, which has a shader of its own.
const int kFilterPoisson = 1, kFilterGaussian = 2, kFilterBox = 3, kFilterKawase = 4;

// Specialisation constant dilate.
const int kDilateOff = 0, kDilateSource = 1, kDilateWrittenOnly = 2;

// Specialisation constant specular_shadow.
const int kSpecularShadowOff = 0, kSpecularShadowSource = 1, kSpecularShadowMap = 2;

// Reading a texture between its texels spreads light like a Gaussian of this variance, in squares of a texel.
const float kBilinearVariance = 1.0f / 6;

// The Gaussian ring below along one axis, in squares of its radius: 2/3 at distance 1, 1/3 at sqrt(2).
const float kRingVariance = 2.0f / 3;

#ifdef __cplusplus
}  // namespace dermis
#else
// Tap i of the eight cells around the middle of 3 x 3, offset and weight: 1 2 1 in both axes without the
// centre's 4, or all alike.
vec3 ring_tap(int i, bool gaussian) {
    int cell = i < 4 ? i : i + 1;
    vec2 offset = vec2(cell % 3, cell / 3) - 1.0;
    return vec3(offset, gaussian ? (2.0 - abs(offset.x)) * (2.0 - abs(offset.y)) / 12.0 : 0.125);
}
#endif
#endif
