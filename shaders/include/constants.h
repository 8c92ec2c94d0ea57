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

// has_wrinkle_map.
const int kWrinkleStretch = 1, kWrinkleCompress = 2;

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

// Specialisation constant gain.
const int kGainNone = 0, kGainCurvature = 1, kGainMap = 2, kGainLinks = 3;

// Specialisation constant view. Own: the technique's own debug view.
const int kViewFinal = 0, kViewDiffuse = 1, kViewSpecular = 2, kViewOwn = 3;

// The disk of a filtered shadow, in the renderer and in the reference (shadow.glsl says what it is).
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
