// What C++ and the shader of this technique agree on. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_SPHERICAL_GAUSSIANS_CONSTANTS_H
#define DERMIS_SPHERICAL_GAUSSIANS_CONSTANTS_H
#ifdef __cplusplus
namespace dermis::spherical_gaussians {
#endif

// Lobes that the uniform block Skin has room for.
const int kMaxLobes = 6;

#ifdef __cplusplus
}  // namespace dermis::spherical_gaussians
#endif
#endif
