// Formulas and limits of posed meshes, for C++ and every shader. Valid C++ and GLSL, compiled by both.
#ifndef DERMIS_SHADERS_INCLUDE_POSING_H
#define DERMIS_SHADERS_INCLUDE_POSING_H
#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#include "dermis/base/vec.h"
namespace dermis::inline base::posing {
using vec3 = Vec3;
using uint = uint32_t;
using std::sqrt;
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

// Derivatives of a surface's position by two coordinates on it.
struct SurfaceDerivatives {
    vec3 x, y, xx, xy, yy;
};
// Curvature tensor dual II dual^T: gradients of the coordinates, and the second fundamental form with the
// sign of CurvatureTensor.
struct CurvatureForm {
    vec3 dual_x, dual_y;
    float xx, xy, yy;
};
// Of a surface whose area is nearly 0, no curvature is known: it is 0.
DERMIS_CONSTANT float kLeastAreaSquared = 1e-6f;

// do Carmo 1976, section 3-3; x cross y points outwards.
DERMIS_FUNCTION CurvatureForm curvature_form(SurfaceDerivatives d) {
    vec3 n = cross(d.x, d.y);
    float area_squared = dot(n, n), xy = dot(d.x, d.y);
    float per_area_squared = area_squared > kLeastAreaSquared ? 1.0f / area_squared : 0.0f;
    vec3 inwards = n * -sqrt(per_area_squared);
    CurvatureForm form;
    form.dual_x = (d.x * dot(d.y, d.y) - d.y * xy) * per_area_squared;
    form.dual_y = (d.y * dot(d.x, d.x) - d.x * xy) * per_area_squared;
    form.xx = dot(inwards, d.xx);
    form.xy = dot(inwards, d.xy);
    form.yy = dot(inwards, d.yy);
    return form;
}

// The tensor times `v`.
DERMIS_FUNCTION vec3 curvature_along(CurvatureForm form, vec3 v) {
    float x = dot(form.dual_x, v), y = dot(form.dual_y, v);
    return form.dual_x * (form.xx * x + form.xy * y) + form.dual_y * (form.xy * x + form.yy * y);
}

// The largest change of curvature that a stencil may make, in 1/mm. In folds, whose walls come close, the fit
// can be off by many times as much.
DERMIS_CONSTANT float kMostCurvatureChange = 0.1f;

// A factor on a change of a tensor, by its Frobenius norm.
DERMIS_FUNCTION float change_limit(vec3 diagonal, vec3 mixed) {
    float norm = sqrt(dot(diagonal, diagonal) + 2.0f * dot(mixed, mixed));
    return norm > kMostCurvatureChange ? kMostCurvatureChange / norm : 1.0f;
}

#undef DERMIS_CONSTANT
#undef DERMIS_FUNCTION
#ifdef __cplusplus
}  // namespace dermis::inline base::posing
#endif
#endif
