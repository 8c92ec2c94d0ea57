// Shadow of the main light. The map is URP's own; shadows in screen space have none that a material could read.
#ifndef DERMIS_SKIN_HEAD_SHADOW
#define DERMIS_SKIN_HEAD_SHADOW

#if (defined(_MAIN_LIGHT_SHADOWS) || defined(_MAIN_LIGHT_SHADOWS_CASCADE)) && !defined(_MAIN_LIGHT_SHADOWS_SCREEN)
#define SKIN_READS_SHADOW_MAP

#define SKIN_SHADOW_IN float3 positionWS,
#define SKIN_SHADOW positionWS,
float SkinSeenAt(float3 positionWS, float3 offset_mm) {
    float4 place = TransformWorldToShadowCoord(positionWS + offset_mm / _MmPerUnit);
    float seen = SAMPLE_TEXTURE2D_SHADOW(_MainLightShadowmapTexture, sampler_LinearClampCompare, place.xyz);
    return BEYOND_SHADOW_FAR(place) ? 1.0 : seen;
}

#include "SkinHeadGather.hlsl"

float SkinShadowTexelMm(float3 positionWS) {
#if defined(_MAIN_LIGHT_SHADOWS_CASCADE)
    int cascade = (int)ComputeCascadeIndex(positionWS);
#else
    int cascade = 0;
#endif
    return _MainLightShadowmapSize.x / length(_MainLightWorldToShadow[cascade][0].xyz) * _MmPerUnit;
}

#endif
#endif
