// Shares of the wrinkle maps in the normal, for C++ and every shader. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_SHADERS_INCLUDE_WRINKLES_H
#define DERMIS_SHADERS_INCLUDE_WRINKLES_H
#ifdef __cplusplus
namespace dermis {
inline
#endif

    // The share of one map: the larger of `weight`, that of its morph target from 0 to 1, and of a line from
    // 0 at the tension `from` to 1 at `full` (dermis/mesh/tension.h). Pass -tension for the map of compressed
    // skin.
    float
    wrinkle_share(float tension, float from, float full, float weight) {
    float share = (tension - from) / (full - from);
    return share < weight ? weight : share > 1 ? 1 : share;
}

// Multiplies the shares of both maps, so that their sum is at most 1.
#ifdef __cplusplus
inline
#endif
    float
    wrinkle_scale(float stretch, float compress) {
    float sum = stretch + compress;
    return sum > 1 ? 1 / sum : 1;
}

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif
