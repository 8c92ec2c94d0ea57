// What the tables and the shaders of this technique agree on. Valid C++ and GLSL, compiled by both. A change
// needs a build, as hot reload follows .glsl only.
#ifndef DERMIS_PREINTEGRATED_CONSTANTS_H
#define DERMIS_PREINTEGRATED_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// Specialisation constants: the order of the parameters' choices.
const int kDiffuseLut = 0, kDiffuseHalfRing = 1, kDiffuseFullRing = 2, kDiffuseCurve2015 = 3,
          kDiffuseClosedForm = 4, kDiffuseWalk = 5;
const int kShadowAuto = 0, kShadowPlain = 1, kShadowScattered = 2, kShadowGathered = 3;
const int kCurvatureVertex = 0, kCurvatureDerivative = 1, kCurvatureImage = 2;
const int kNormalsAuto = 0, kNormalsBaked = 1, kNormalsBlended = 2, kNormalsLerp = 3, kNormalsSmooth = 4,
          kNormalsSharp = 5;
const int kAmbientProfile = 0, kAmbientExact = 1, kAmbientCurve2015 = 2;

// The tables hold curvatures from 0 to this.
const float kMaxCurvaturePerMm = 1.0;

// Mip levels of the smoother normal above the sharp one, as published (Penner 2011); normals=blended takes at
// most as many.
const float kPublishedNormalLevels = 3.0;

// Terms of a polynomial of curvature (dermis/optics/curvature_expressions.h); Gaussians of the profile that
// the block Skin has room for.
const int kPolynomialTerms = 6, kMaxGaussians = 24;

// Gaussians that transmission without tables sums for each tap: a loop of known length costs a fraction of
// another.
const int kTransmissionGaussians = 6;

// Rows of skin_rows. Over an argument from 0 to 1: zonal harmonics of order 0 to 2 over curvature; the
// shadow's edge over visibility; weights and levels of the smoother normal over log2 of a texel of the normal
// map in mm, and the same with the published levels; the sphere of red's mean normal over sqrt(1 - its
// length), as curvature over kMaxCurvaturePerMm and what is left of the cosine lobe's second band. By texel:
// weights and places of the shadow's taps (weights.h).
const int kRowZonal = 0, kRowShadow = 3, kRowNormals = 4, kRowPublishedNormals = 5, kRowOfMean = 6,
          kRowTapWeights = 7, kRowTapPlaces = 8, kRowCount = 9, kRowTexels = 257;
// Taps of shadow=gathered; the row has the farthest of them first. An edge within their reach divides them,
// so that pixels whose first taps agree need no more.
const int kShadowGatherTaps = 64, kShadowFirstTaps = 16;
// How far a place is lifted off the quadric, over its distance.
const float kGatherLiftSlope = 0.15f;

// 4 microns to 16 mm.
const float kMinLogMm = -8.0, kMaxLogMm = 4.0;

// Terms of a shadow's edge without a table (dermis/optics/edge_expression.h).
const int kEdgeWeights = 6;

// N.L up to which a shadow's edge is as wide as the penumbra, and from which it scatters.
const float kGrazing = 0.3, kSteep = 0.7;

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif
