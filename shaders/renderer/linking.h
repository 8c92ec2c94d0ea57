// Links of vertices (dermis/render/linked_light.h), for C++ and shaders.
#ifndef DERMIS_LINKING_H
#define DERMIS_LINKING_H

#ifdef __cplusplus
#include <cstdint>
namespace dermis {
using uint = uint32_t;
#define DERMIS_LINK_CONSTANT inline constexpr
#else
#define DERMIS_LINK_CONSTANT const
#endif

DERMIS_LINK_CONSTANT uint kLinkLanes = 8u;   // threads of a vertex
DERMIS_LINK_CONSTANT uint kLinkBlock = 64u;  // threads of a group
DERMIS_LINK_CONSTANT uint kLinkBits0 = 11u;  // of a weight, with its sign: red
DERMIS_LINK_CONSTANT uint kLinkBits1 = 11u;
DERMIS_LINK_CONSTANT uint kLinkBits2 = 10u;

#ifndef __cplusplus
// Irradiance of a vertex as halves.
struct EnteringLight {
    uint red_green, blue;
};
#endif

#undef DERMIS_LINK_CONSTANT
#ifdef __cplusplus
}  // namespace dermis
#endif

#endif
