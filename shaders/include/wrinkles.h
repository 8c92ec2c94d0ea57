// Share of a wrinkle map in the normal, for C++ and every shader. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_SHADERS_INCLUDE_WRINKLES_H
#define DERMIS_SHADERS_INCLUDE_WRINKLES_H
#ifdef __cplusplus
namespace dermis {
inline
#endif

    // A line from 0 at `from` to 1 at `full`, sizes of a tension of either sign (dermis/mesh/tension.h).
    float
    wrinkle_share(float tension, float from, float full) {
    float size = tension < 0 ? -tension : tension;
    float share = (size - from) / (full - from);
    return share < 0 ? 0 : share > 1 ? 1 : share;
}

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif
