// Formulas and limits of posed meshes, for C++ and every shader. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_SHADERS_INCLUDE_POSING_H
#define DERMIS_SHADERS_INCLUDE_POSING_H
#ifdef __cplusplus
#include <cstdint>
#include "dermis/base/vec.h"
namespace dermis::inline base::posing {
using vec3 = Vec3;
using uint = uint32_t;
#define DERMIS_CONSTANT inline constexpr
#define DERMIS_FUNCTION inline
#else
#define DERMIS_CONSTANT const
#define DERMIS_FUNCTION
#endif

// A sum of face normals that is shorter cancels: its faces lie on opposite sides of a fold.
DERMIS_CONSTANT float kShortestNormalSum = 1e-4f;
// A normal whose square is smaller is missing.
DERMIS_CONSTANT float kLeastNormalSquared = 1e-12f;
// Cosine between a normal before and after, below which there is no smallest rotation.
DERMIS_CONSTANT float kOppositeNormals = -0.999f;
// Tensions stay within +-4, which is an area times or divided by 55.
DERMIS_CONSTANT float kMostTension = 4.0f;

// Compute passes of posing: places of a block, threads of a group.
DERMIS_CONSTANT uint kPoseBlock = 64u;
// What the triangle between the places of two entries of a ring counts for, in the top bits of the later one:
// the vertex's normal; its tension; UVs of the atlas there. UVs that it does not count for have steps of 0.
// An entry without these bits begins a ring. One has the last normal that counts.
DERMIS_CONSTANT uint kCornerJoined = 0x80000000u;
DERMIS_CONSTANT uint kCornerDrawn = 0x40000000u;
DERMIS_CONSTANT uint kCornerInAtlas = 0x20000000u;
DERMIS_CONSTANT uint kCornerKinds = 0xE0000000u;
DERMIS_CONSTANT uint kCornerLast = 0x10000000u;
DERMIS_CONSTANT uint kRingPlace = 0x0FFFFFFFu;
// Influences that are one matrix alone have its number, with this bit.
DERMIS_CONSTANT uint kOneMatrix = 0x80000000u;
// A vertex whose dP/du of the file's UVs is along that of the atlas.
DERMIS_CONSTANT uint kAlongAtlas = 0xFFFFFFFFu;

// `v` turned by the smallest rotation from one unit vector to another, which are not opposite (Moller and
// Hughes 1999, "Efficiently Building a Matrix to Rotate One Vector to Another").
DERMIS_FUNCTION vec3 turned(vec3 from, vec3 to, vec3 v) {
    vec3 axis = cross(from, to);
    float cosine = dot(from, to);
    return v * cosine + cross(axis, v) + axis * (dot(axis, v) / (1.0f + cosine));
}

#undef DERMIS_CONSTANT
#undef DERMIS_FUNCTION
#ifdef __cplusplus
}  // namespace dermis::inline base::posing
#endif
#endif
