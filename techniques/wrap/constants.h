// What technique.cpp and wrap.frag agree on. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_WRAP_CONSTANTS_H
#define DERMIS_WRAP_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// Specialisation constant width.
const int kWidthProfile = 0, kWidthSource = 1;

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif
