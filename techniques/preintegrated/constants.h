// What the tables and preintegrated.frag agree on. Valid C++ and GLSL, compiled by both, so that a number is
// written once; a change needs a build, as hot reload follows .glsl only.
#ifndef DERMIS_PREINTEGRATED_CONSTANTS_H
#define DERMIS_PREINTEGRATED_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// Specialisation constants: the order of the parameters' choices.
const int kDiffuseLut = 0, kDiffuseCurve2015 = 1, kDiffuseClosedForm = 2;
const int kShadowPlain = 0, kShadowScattered = 1, kShadowGathered = 2;
const int kCurvatureVertex = 0, kCurvatureDerivative = 1, kCurvatureImage = 2;
const int kNormalsSharp = 0, kNormalsSmooth = 1, kNormalsBlended = 2, kNormalsLerp = 3, kNormalsBaked = 4;
const int kAmbientExact = 0, kAmbientLut = 1, kAmbientCurve2015 = 2;

// The tables hold curvatures from 0 to this.
const float kMaxCurvaturePerMm = 1.0;

// Of a polynomial of curvature (dermis/optics/curvature_expressions.h), and of the profile that the block
// Skin can have.
const int kPolynomialTerms = 6, kMaxGaussians = 24;

// That transmission takes the profile for without tables: a loop whose length is known costs a fraction of
// one that asks.
const int kTransmissionGaussians = 6;

// Rows of skin_rows, each over its own argument from 0 to 1: zonal harmonics of order 0 to 2 over curvature,
// the shadow's edge over visibility, weights and levels of the smoother normal over log2 of a texel of the
// normal map in mm, and the sphere of red's mean normal over sqrt(1 - its length): curvature over
// kMaxCurvaturePerMm, and what is left of the cosine lobe's second band. Two are read by texels: weights
// and places of shadow_taps.h.
const int kRowZonal = 0, kRowShadow = 3, kRowNormals = 4, kRowOfMean = 5, kRowTapWeights = 6,
          kRowTapPlaces = 7, kRowCount = 8, kRowTexels = 257;
// Every fourth stands first.
const int kShadowGatherTaps = 64, kShadowFirstTaps = 16;
// How far a place is lifted off the quadric, over its distance.
const float kGatherLiftSlope = 0.15f;

// 4 microns to 16 mm.
const float kMinLogMm = -8.0, kMaxLogMm = 4.0;

// Of a shadow's edge without a table (dermis/optics/edge_expression.h).
const int kEdgeWeights = 6;

// N.L up to which a shadow's edge is as wide as the penumbra, and from which it scatters.
const float kGrazing = 0.3, kSteep = 0.7;

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif
