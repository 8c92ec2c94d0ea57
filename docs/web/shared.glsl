// shaders/include/constants.h
// What C++ and every shader agree on. Valid C++ and GLSL, compiled by both, so that a number is written
// once; a change needs a build, as hot reload follows .glsl only.
#ifndef DERMIS_SHADERS_INCLUDE_CONSTANTS_H
#define DERMIS_SHADERS_INCLUDE_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// LightSource::kind.
const int kLightDirectional = 0, kLightPoint = 1, kLightSpot = 2;

// Material::normal_space; absent: no normal map.
const int kNormalSpaceTangent = 0, kNormalSpaceObject = 1, kNormalSpaceAbsent = 2;

// Lights with a shadow map, at most; the first is the key light's. A fourth would need more textures than the
// 32 that some drivers have for a shader.
const int kMaxShadowMaps = 3;

// Specialisation constant specular_model.
const int kSpecularNone = 0, kSpecularBlinnPhong = 1, kSpecularGgx = 2, kSpecularTwoLobe = 3,
          kSpecularKsk = 4;

// The table of what lobes reflect (dermis/scene/brdf_table.h): texels on a side, and one such square for each
// lobe.
const int kBrdfTableSize = 64;
const int kBrdfLobeGgx = 0, kBrdfLobeKsk = 1, kBrdfLobes = 2;

// The roughness that a lobe of Beckmann's distribution has in the environment that is prefiltered for GGX:
// times clamp(at 0 + slope * roughness, least, most). Fitted to the light within each angle of the mirrored
// direction, which then differs by 0.10 at most, and by 0.08 from a roughness of 0.45; with the same
// roughness by 0.20.
const float kBeckmannAsGgxAt0 = 0.77, kBeckmannAsGgxSlope = 0.38, kBeckmannAsGgxLeast = 0.86,
            kBeckmannAsGgxMost = 1.08;

// Specialisation constant transmission.
const int kTransmissionNone = 0, kTransmissionShadowMap = 1;
const int kTransmissionTexels = 1025;  // of the table skin_transmission

// Specialisation constant view. Own: the technique's own debug view.
const int kViewFinal = 0, kViewDiffuse = 1, kViewSpecular = 2, kViewOwn = 3;

// The disk of a filtered shadow, in the renderer and in the ground truth (shadow.glsl says what it is).
const float kShadowConcavity = 0.1;  // curvature times the disk's radius, up to which the disk is lifted
const float kShadowFacetLift = 0.3;  // in radii: the tangent plane of a smooth normal cuts through the facets
const float kShadowMaxSlope = 4.0;   // of the plane against the light: 76 degrees
const int kShadowTaps = 24, kShadowOuterTaps = 8;

// Between the points of a Vogel spiral, radians (Vogel 1979).
const float kGoldenAngle = 2.39996323;

// Variances along one axis of the three blurs of the occlusion at the vertices: less than 0.5 counts as
// sharp, and no Gaussian of skin is wider than 8.
const float kOcclusionVariance0Mm2 = 0.5, kOcclusionVariance1Mm2 = 2.0, kOcclusionVariance2Mm2 = 8.0;

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif

// shaders/renderer/constants.h
// What C++ and the renderer's own passes agree on. Valid C++ and GLSL, compiled by both, so that a number is
// written once; a change needs a build, as hot reload follows .glsl only.
#ifndef DERMIS_SHADERS_RENDERER_CONSTANTS_H
#define DERMIS_SHADERS_RENDERER_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// Specialisation constant tone_map: dermis/image/tone_map.h.
const int kToneMapNone = 0, kToneMapHable = 1, kToneMapAces = 2, kToneMapPbrNeutral = 3;

// Specialisation constant blended: what of the blended materials a pass draws.
const int kBlendedNot = 0, kBlendedCore = 1, kBlendedRim = 2;

// Specialisation constant shown: which attribute of the G-buffer.
const int kShownNormal = 0, kShownGeometryNormal = 1, kShownAlbedo = 2, kShownRoughness = 3,
          kShownCurvature = 4, kShownOcclusion = 5, kShownShadow = 6, kShownNDotL = 7, kShownDepth = 8,
          kShownUv = 9, kShownPosition = 10, kShownCount = 11;

// Signed colours are full at this curvature.
const float kFullCurvaturePerMm = 0.125;
// The colour bar of the legend, in its pixels.
const int kLegendBarLeft = 24, kLegendBarRight = 264, kLegendBarTop = 4, kLegendBarBottom = 18;

// How the window arranges its pictures.
const int kArrangementNone = 0, kArrangementOne = 1, kArrangementWipe = 2, kArrangementSideBySide = 3;

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif

// techniques/preintegrated/constants.h
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

// shaders/renderer/tone_map.glsl
// Tone mapping, linear in and linear out (0..1), and the sRGB encoding.
#ifndef DERMIS_TONE_MAP_GLSL
#define DERMIS_TONE_MAP_GLSL


// Hable 2010, "Uncharted 2: HDR Lighting": ratio of two quadratics, shoulder .15, linear .5 at angle .1, toe .2,
// numerator .02, denominator .3; white 11.2; exposure bias 2.
vec3 hable_curve(vec3 x) {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.50) + 0.06) - 0.02 / 0.30;
}
vec3 hable(vec3 radiance) { return hable_curve(2.0 * radiance) / hable_curve(vec3(11.2)).x; }

// ACES RRT and ODT as fitted by Hill 2015 (in "BakingLab"): matrices in, rational curve, matrices out.
vec3 aces(vec3 radiance) {
    const mat3 to_rrt = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 from_odt = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = to_rrt * radiance;
    vec3 curve = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return from_odt * curve;
}

// Khronos PBR Neutral 2024: identity but for an F0 offset up to .8 - .04, then compression that desaturates.
vec3 pbr_neutral(vec3 radiance) {
    const float start = 0.8 - 0.04, desaturation = 0.15;
    float low = min(radiance.r, min(radiance.g, radiance.b));
    float offset = low < 0.08 ? low - 6.25 * low * low : 0.04;
    vec3 color = radiance - offset;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < start) return color;
    float d = 1.0 - start;
    float new_peak = 1.0 - d * d / (peak + d - start);
    color *= new_peak / peak;
    float g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(color, vec3(new_peak), g);
}

vec3 tone_mapped(vec3 radiance, int operator_index) {
    vec3 color = radiance;
    if (operator_index == kToneMapHable) color = hable(radiance);
    if (operator_index == kToneMapAces) color = aces(radiance);
    if (operator_index == kToneMapPbrNeutral) color = pbr_neutral(radiance);
    return clamp(color, 0.0, 1.0);
}

vec3 srgb_encode(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055,
               greaterThan(linear, vec3(0.0031308)));
}

#endif

