// Constants that C++ and the renderer's passes share. Valid C++ and GLSL, compiled by both, so that a number
// is written once; a change needs a build, as hot reload follows .glsl only.
#ifndef DERMIS_SHADERS_RENDERER_CONSTANTS_H
#define DERMIS_SHADERS_RENDERER_CONSTANTS_H
#ifdef __cplusplus
namespace dermis {
#endif

// Specialisation constant tone_map: dermis/image/tone_map.h.
const int kToneMapNone = 0, kToneMapHable = 1, kToneMapAces = 2, kToneMapPbrNeutral = 3;

// Specialisation constant blended: the part of the blended materials that a pass draws.
const int kBlendedNot = 0, kBlendedCore = 1, kBlendedRim = 2;

// Specialisation constant shown: attribute of the G-buffer.
const int kShownNormal = 0, kShownGeometryNormal = 1, kShownAlbedo = 2, kShownRoughness = 3,
          kShownCurvature = 4, kShownOcclusion = 5, kShownShadow = 6, kShownNDotL = 7, kShownDepth = 8,
          kShownUv = 9, kShownPosition = 10, kShownTension = 11, kShownCount = 12;

// Curvature of full colour.
const float kFullCurvaturePerMm = 0.125;
// Tension of full colour: ln(area / area at rest).
const float kFullTension = 0.5;
// The colour bar of the legend, in its pixels.
const int kLegendBarLeft = 24, kLegendBarRight = 264, kLegendBarTop = 4, kLegendBarBottom = 18;

// How the window arranges its pictures.
const int kArrangementNone = 0, kArrangementOne = 1, kArrangementWipe = 2, kArrangementSideBySide = 3;

#ifdef __cplusplus
}  // namespace dermis
#endif
#endif
